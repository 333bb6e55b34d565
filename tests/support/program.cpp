#include "tests/support/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace seam {
namespace {

namespace fs = std::filesystem;

std::string ReadAll(int fd) {
  std::string text;
  char buffer[4096];
  for (ssize_t got = 0;
       (got = pread(fd, buffer, sizeof buffer, static_cast<off_t>(text.size()))) > 0;) {
    text.append(buffer, static_cast<std::size_t>(got));
  }
  return text;
}

void Pause() { usleep(5000); }
int Pauses(double seconds) { return static_cast<int>(seconds * 200); }

}  // namespace

std::string BuiltProgram(const std::string& name) {
  const char* const folder = std::getenv("SEAM_BIN");
  const fs::path bin =
      folder != nullptr ? fs::path(folder) : fs::read_symlink("/proc/self/exe").parent_path();
  return fs::absolute(bin / name).string();
}

Program::Program(const std::vector<std::string>& argv, const std::string& folder, int terminal)
    : output_fd_(memfd_create("output", MFD_CLOEXEC)),
      errors_fd_(memfd_create("errors", MFD_CLOEXEC)) {
  std::vector<char*> pointers;
  for (const std::string& word : argv) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const int input = terminal >= 0 ? terminal : open("/dev/null", O_RDONLY | O_CLOEXEC);
  pid_ = fork();
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive the test
    signal(SIGINT, SIG_DFL);  // a shell has background jobs ignore it
    if (!folder.empty() && chdir(folder.c_str()) != 0) _exit(126);
    dup2(input, 0);
    dup2(output_fd_, 1);
    dup2(errors_fd_, 2);
    execvp(pointers[0], pointers.data());
    _exit(127);
  }
  if (terminal < 0) close(input);
}

Program::~Program() {
  if (pid_ > 0) {
    Signal(SIGKILL);
    Wait(10);
  }
  close(output_fd_);
  close(errors_fd_);
}

bool Program::Wait(double seconds) {
  for (int i = 0; pid_ > 0 && i <= Pauses(seconds); ++i) {
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      pid_ = -1;
    } else {
      Pause();
    }
  }
  return pid_ <= 0;
}

bool Program::WaitForErrors(const std::string& text, double seconds) {
  for (int i = 0; i <= Pauses(seconds); ++i) {
    if (errors().find(text) != std::string::npos) return true;
    if (Wait(0)) break;
    Pause();
  }
  return errors().find(text) != std::string::npos;
}

void Program::Signal(int signal) {
  if (pid_ > 0) kill(pid_, signal);
}

std::string Program::output() const { return ReadAll(output_fd_); }
std::string Program::errors() const { return ReadAll(errors_fd_); }

std::string Program::Story() const {
  return "status " + std::to_string(status_) + "\nstdout: " + output() + "\nstderr: " + errors();
}

PseudoTerminal::PseudoTerminal() : keyboard_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (keyboard_ < 0 || grantpt(keyboard_) != 0 || unlockpt(keyboard_) != 0) return;
  terminal_ = open(ptsname(keyboard_), O_RDWR | O_NOCTTY | O_CLOEXEC);
}

PseudoTerminal::~PseudoTerminal() {
  HangUp();
  if (terminal_ >= 0) close(terminal_);
}

void PseudoTerminal::Type(const std::string& keys) {
  EXPECT_EQ(write(keyboard_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
}

bool PseudoTerminal::IsCooked() const {
  termios settings{};
  EXPECT_EQ(tcgetattr(terminal_, &settings), 0);
  return (settings.c_lflag & ICANON) != 0 && (settings.c_lflag & ECHO) != 0;
}

void PseudoTerminal::HangUp() {
  if (keyboard_ >= 0) close(keyboard_);
  keyboard_ = -1;
}

Workspace::Workspace() : path_(::testing::TempDir() + "seam-work-XXXXXX") {
  EXPECT_NE(mkdtemp(path_.data()), nullptr);
}

Workspace::~Workspace() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void Workspace::Write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ + "/" + name, std::ios::binary) << text;
}

std::vector<std::string> Workspace::Content() const {
  std::vector<std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(path_)) {
    std::string line = fs::relative(entry.path(), path_).string();
    if (entry.is_regular_file()) {
      std::ifstream file(entry.path(), std::ios::binary);
      line += ": " + std::string(std::istreambuf_iterator<char>(file), {});
    }
    content.push_back(line);
  }
  std::sort(content.begin(), content.end());
  return content;
}

}  // namespace seam
