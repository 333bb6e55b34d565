#include "client/front/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "client/front/verbs.h"
#include "common/base/check.h"
#include "common/base/process.h"

namespace seam {
namespace {

/// Makes `fd` the descriptor `as` of the program that is about to start; of -1 an empty one.
void Give(int fd, int as) {
  const int from = fd >= 0 ? fd : open("/dev/null", O_RDWR | O_CLOEXEC);
  if (from == as) {
    (void)fcntl(as, F_SETFD, 0);
  } else {
    (void)dup2(from, as);
  }
}

}  // namespace

int ReadableText(const std::string& text) {
  int pipe[2] = {-1, -1};
  if (pipe2(pipe, O_CLOEXEC) != 0) throw OperatorError("no pipe");
  const bool written =
      write(pipe[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(pipe[1]);
  if (!written) throw OperatorError("no pipe");
  return pipe[0];
}

Child::Child(const std::vector<std::string>& words, const ChildFiles& files) : name_(words[0]) {
  std::vector<std::string> copies = words;
  std::vector<char*> argv;
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string path = ProgramPath(name_);
  pid_ = fork();
  if (pid_ < 0) throw OperatorError(name_ + ": " + std::strerror(errno));
  if (pid_ > 0) return;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  // Ctrl-C reaches us alone: we end the programs in their order.
  if (!files.terminal) setpgid(0, 0);
  signal(SIGPIPE, SIG_DFL);
  const int third = files.third >= 0 ? fcntl(files.third, F_DUPFD_CLOEXEC, 10) : -1;
  const int errors = files.errors >= 0 ? fcntl(files.errors, F_DUPFD_CLOEXEC, 10) : -1;
  if (!files.terminal) {
    const int input = files.input >= 0 ? fcntl(files.input, F_DUPFD_CLOEXEC, 10) : -1;
    const int output = files.output >= 0 ? fcntl(files.output, F_DUPFD_CLOEXEC, 10) : -1;
    Give(input, 0);
    Give(output, 1);
  }
  Give(errors, 2);
  if (third >= 0) Give(third, 3);
  execvp(path.c_str(), argv.data());
  _exit(127);
}

int Child::End() {
  Interrupt();
  for (int i = 0; i < 300 && running(); ++i) SleepUs(10000);
  if (!running()) return status_;
  kill(pid_, SIGKILL);
  (void)waitpid(pid_, nullptr, 0);
  return status_ = 128 + SIGKILL;
}

bool Child::running() {
  if (pid_ <= 0 || status_ >= 0) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) == 0) return true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return false;
}

void Child::Interrupt() {
  if (running()) kill(pid_, SIGINT);
}

}  // namespace seam
