#include "tests/lab/report/gnuplot.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "common/base/check.h"
#include "tests/lab/experiment/jobs.h"

namespace seam {
namespace {

/// Of execvp, when there is no such program.
constexpr int kNotFound = 127;

/// Runs gnuplot with `arguments` in `folder`, what it says into `log`; its exit status.
int Gnuplot(const std::string& folder, const std::vector<std::string>& arguments,
            const std::string& log) {
  std::vector<char*> argv;
  std::string program = "gnuplot";
  std::vector<std::string> copies = arguments;
  argv.push_back(program.data());
  for (std::string& copy : copies) argv.push_back(copy.data());
  argv.push_back(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (out >= 0) {
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
    }
    if (chdir(folder.c_str()) == 0) execvp(argv[0], argv.data());
    _exit(kNotFound);
  }
  int status = 0;
  if (pid < 0 || waitpid(pid, &status, 0) != pid || !WIFEXITED(status)) return 1;
  return WEXITSTATUS(status);
}

/// The first line that says something.
std::string Complaint(const std::string& log) {
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  }
  return "";
}

}  // namespace

void RequireGnuplot() {
  if (Gnuplot(".", {"--version"}, "/dev/null") != 0) {
    throw OperatorError("gnuplot does not run; install it: apt-get install gnuplot-nox");
  }
}

void RunGnuplot(const std::string& folder, const std::vector<std::string>& scripts, int jobs) {
  // Some scripts a process: starting one takes as long as drawing several small figures.
  constexpr std::size_t kBatch = 8;
  const std::size_t batches = (scripts.size() + kBatch - 1) / kBatch;
  std::string failure;
  RunJobs(
      batches, jobs,
      [&](std::size_t i) {
        const auto begin = scripts.begin() + static_cast<std::ptrdiff_t>(i * kBatch);
        const auto size = std::min(kBatch, scripts.size() - i * kBatch);
        const std::string log = folder + "/gnuplot-" + std::to_string(i) + ".log";
        const int status = Gnuplot(folder, {begin, begin + static_cast<std::ptrdiff_t>(size)}, log);
        const std::string complaint = Complaint(log);
        std::remove(log.c_str());
        if (status == 0) return std::string();
        throw OperatorError("gnuplot, status " + std::to_string(status) + ": " + complaint);
      },
      [&](std::size_t, const JobResult& result) {
        if (!result.good && failure.empty()) failure = result.text;
      },
      [] { return false; });
  if (!failure.empty()) throw OperatorError(folder + ": " + failure);
}

}  // namespace seam
