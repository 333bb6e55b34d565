#pragma once
/// A program that a test starts, waits for with a timeout, and ends by its process id.

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace seam {

class ChildProcess {
 public:
  /// Starts argv[0] (looked up in PATH); keeps its output for output().
  explicit ChildProcess(const std::vector<std::string>& argv)
      : output_fd_(memfd_create("output", MFD_CLOEXEC)) {
    std::vector<char*> pointers;
    for (const std::string& word : argv) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive the test
    dup2(output_fd_, 1);
    dup2(output_fd_, 2);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  ~ChildProcess() {
    Stop(SIGKILL);
    close(output_fd_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits at most `seconds` for the program's end; returns true if it has ended.
  bool Wait(int seconds) {
    for (int i = 0; i < seconds * 100 && pid_ > 0; ++i) {
      int status = 0;
      if (waitpid(pid_, &status, WNOHANG) == pid_) {
        exit_status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        pid_ = -1;
      } else {
        usleep(10000);
      }
    }
    return pid_ <= 0;
  }

  /// Sends `signal` and waits; kills the program if it does not end.
  void Stop(int signal) {
    if (pid_ <= 0) return;
    kill(pid_, signal);
    if (Wait(10)) return;
    kill(pid_, SIGKILL);
    Wait(10);
  }

  /// Exit status; 128 + signal if the program was killed; -1 while it runs.
  int exit_status() const { return exit_status_; }

  std::string output() const {
    std::string text(1 << 16, '\0');
    const ssize_t bytes = pread(output_fd_, text.data(), text.size(), 0);
    text.resize(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
    return text;
  }

 private:
  int output_fd_;
  pid_t pid_ = -1;
  int exit_status_ = -1;
};

}  // namespace seam
