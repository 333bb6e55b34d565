#include "render/drawing_processes.h"

#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <new>
#include <string>
#include <vector>

#include "common/base/check.h"

namespace seam {
namespace {

/// Message of a child for each item; shorter than PIPE_BUF, so that writes are atomic.
struct Report {
  bool failed = false;
  char message[511] = "";
};

/// A counter in memory shared by all processes.
class SharedCounter {
 public:
  SharedCounter()
      : memory_(mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE,
                     MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw OperatorError("no memory for drawing");
    value_ = new (memory_) std::atomic<int>(0);
  }
  ~SharedCounter() { munmap(memory_, sizeof(std::atomic<int>)); }
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;

  std::atomic<int>& value() { return *value_; }

 private:
  static_assert(std::atomic<int>::is_always_lock_free);
  void* memory_;
  std::atomic<int>* value_ = nullptr;
};

void Send(int to, const Report& report) {
  ssize_t written;
  do {
    written = write(to, &report, sizeof report);
  } while (written < 0 && errno == EINTR);
}

/// Runs a child: draws the next free item until none is left.
[[noreturn]] void DrawNext(int count, const std::function<void(int)>& draw,
                           std::atomic<int>* next, int to) {
  Report report;
  try {
    for (int item = (*next)++; item < count; item = (*next)++) {
      draw(item);
      Send(to, report);
    }
  } catch (const std::exception& error) {
    *next = count;
    report.failed = true;
    strncpy(report.message, error.what(), sizeof report.message - 1);
    Send(to, report);
  }
  _exit(0);  // the buffers and exit handlers are the parent's
}

/// The child processes. The destructor kills and reaps them in any case.
class Children {
 public:
  ~Children() {
    for (const pid_t child : running_) kill(child, SIGKILL);
    Wait();
  }

  template <class Work>
  void Start(const Work& work) {
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) throw OperatorError(std::string("cannot start a process: ") + strerror(errno));
    if (child > 0) {
      running_.push_back(child);
      return;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    work();
  }

  /// Waits for all children. Returns a signal that ended one of them, or 0.
  int Wait() {
    int signal = 0;
    for (const pid_t child : running_) {
      int status = 0;
      while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      if (WIFSIGNALED(status)) signal = WTERMSIG(status);
    }
    running_.clear();
    return signal;
  }

 private:
  std::vector<pid_t> running_;
};

class Pipe {
 public:
  Pipe() {
    if (pipe(ends_) != 0) throw OperatorError(std::string("no pipe: ") + strerror(errno));
  }
  ~Pipe() {
    close(ends_[0]);
    CloseWriting();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void CloseWriting() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  /// Reads the next report. Returns false when all children have closed the pipe.
  bool Read(Report* report) const {
    std::size_t have = 0;
    while (have < sizeof *report) {
      const ssize_t got =
          read(ends_[0], reinterpret_cast<char*>(report) + have, sizeof *report - have);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      have += static_cast<std::size_t>(got);
    }
    return true;
  }

 private:
  int ends_[2];
};

}  // namespace

void DrawInProcesses(int count, int processes, const std::function<void(int item)>& draw,
                     const std::function<void(int done)>& progress) {
  SharedCounter next;
  Pipe pipe;
  Children children;
  for (int i = 0; i < processes; ++i) {
    children.Start([&] {
      close(pipe.reading());
      DrawNext(count, draw, &next.value(), pipe.writing());
    });
  }
  pipe.CloseWriting();
  int done = 0;
  std::string error;
  Report report;
  while (pipe.Read(&report)) {
    if (!report.failed) {
      progress(++done);
    } else if (error.empty()) {
      error = report.message;
    }
  }
  const int signal = children.Wait();
  if (!error.empty()) throw OperatorError(error);
  if (signal != 0)
    throw OperatorError(std::string("a drawing process was ended: ") + strsignal(signal));
  SEAM_ASSERT(done == count);
}

}  // namespace seam
