#include "tests/lab/experiment/jobs.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <vector>

#include "common/base/check.h"

namespace seam {
namespace {

struct Job {
  std::size_t index = 0;
  pid_t pid = -1;
  int fd = -1;        ///< where its result comes from
  std::string heard;  ///< 'R' and the result, or 'E' and the error
};

[[noreturn]] void Work(int fd, std::size_t index,
                       const std::function<std::string(std::size_t)>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive the sweep
  signal(SIGINT, SIG_IGN);           // Ctrl-C reaches all: the sweep decides
  signal(SIGTERM, SIG_DFL);
  // What is open belongs to the sweep: the lock of its table ends with it, not with its jobs.
  const auto own = static_cast<unsigned>(fd);
  if (own > STDERR_FILENO + 1) (void)close_range(STDERR_FILENO + 1, own - 1, 0);
  (void)close_range(own + 1, ~0U, 0);
  std::string said;
  try {
    said = "R" + work(index);
  } catch (const std::exception& e) {
    said = std::string("E") + e.what();
  }
  for (std::size_t at = 0; at < said.size();) {
    const ssize_t wrote = write(fd, said.data() + at, said.size() - at);
    if (wrote <= 0) _exit(1);
    at += static_cast<std::size_t>(wrote);
  }
  _exit(0);
}

Job Start(std::size_t index, const std::function<std::string(std::size_t)>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw OperatorError(std::string("no pipe: ") + std::strerror(errno));
  std::fflush(nullptr);  // or both would write what is buffered
  Job job;
  job.index = index;
  job.fd = ends[0];
  job.pid = fork();
  if (job.pid == 0) {
    close(ends[0]);
    Work(ends[1], index, work);
  }
  const int error = errno;
  close(ends[1]);
  if (job.pid < 0) {
    close(ends[0]);
    throw OperatorError(std::string("no process: ") + std::strerror(error));
  }
  return job;
}

JobResult Finish(const Job& job) {
  close(job.fd);
  int status = 0;
  while (waitpid(job.pid, &status, 0) < 0 && errno == EINTR) {
  }
  JobResult result;
  if (WIFSIGNALED(status)) {
    result.text = std::string("crashed: ") + strsignal(WTERMSIG(status));
  } else if (status != 0 || job.heard.empty()) {
    result.text = "ended without a result";
  } else {
    result.good = job.heard[0] == 'R';
    result.text = job.heard.substr(1);
  }
  return result;
}

/// Ends what still runs, also when something is thrown.
struct Running {
  std::vector<Job> jobs;
  ~Running() {
    for (const Job& job : jobs) {
      kill(job.pid, SIGKILL);
      Finish(job);
    }
  }
  /// Waits at most half a second, hears what there is, and returns what has ended, by index.
  std::map<std::size_t, JobResult> Hear() {
    std::map<std::size_t, JobResult> results;
    std::vector<pollfd> polls;
    for (const Job& job : jobs) polls.push_back({job.fd, POLLIN, 0});
    if (poll(polls.data(), polls.size(), 500) <= 0) return results;
    for (std::size_t i = jobs.size(); i-- > 0;) {
      if (polls[i].revents == 0) continue;
      char buffer[4096];
      const ssize_t bytes = read(jobs[i].fd, buffer, sizeof buffer);
      if (bytes > 0) jobs[i].heard.append(buffer, static_cast<std::size_t>(bytes));
      if (bytes > 0 || (bytes < 0 && errno == EINTR)) continue;
      const Job job = jobs[i];
      jobs.erase(jobs.begin() + static_cast<std::ptrdiff_t>(i));
      results[job.index] = Finish(job);
    }
    return results;
  }
};

}  // namespace

void RunJobs(std::size_t count, int jobs, const std::function<std::string(std::size_t)>& work,
             const std::function<void(std::size_t, const JobResult&)>& done,
             const std::function<bool()>& stop) {
  Running running;
  std::size_t begun = 0, handed = 0;
  while (handed < count && !stop()) {
    while (begun < count && running.jobs.size() < static_cast<std::size_t>(jobs)) {
      running.jobs.push_back(Start(begun++, work));
    }
    for (const auto& [index, result] : running.Hear()) {
      ++handed;
      done(index, result);
    }
  }
}

}  // namespace seam
