#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "common/base/check.h"
#include "common/base/process.h"
#include "tests/lab/chaos/chaos.h"
#include "tests/lab/commands.h"
#include "tests/lab/experiment/jobs.h"

namespace seam {

std::string CommandOf(std::uint64_t seed, const ChaosChoice& choice) {
  std::string text =
      fmt::format("seam-lab chaos --seeds 1 --first {} --seconds {:g}", seed, choice.seconds);
  for (std::size_t i = 0; i < choice.scenes.size(); ++i) {
    text += (i == 0 ? " --scene " : ",") + choice.scenes[i];
  }
  return text;
}

namespace {

/// Throws OperatorError if the scenes are not there: that is no fault of a session.
void RequireScenes(const std::vector<std::string>& scenes) {
  std::error_code error;
  if (!std::filesystem::is_directory("scenes", error)) {
    throw OperatorError("chaos plays the scenes of the folder scenes, and there is none here");
  }
  for (const std::string& scene : scenes) {
    const std::string path = "scenes/" + scene + ".toml";
    if (!std::filesystem::exists(path, error)) throw OperatorError(path + ": there is none");
  }
}

}  // namespace

int RunChaosSeeds(const ChaosCommand& command) {
  RequireScenes(command.scenes);
  StopOnSignals();
  ChaosChoice choice;
  choice.scenes = command.scenes;
  choice.seconds = command.seconds;
  const auto seed = [&](std::size_t n) { return static_cast<std::uint64_t>(command.first) + n; };
  int failed = 0, restarts = 0;
  const auto run = [&](std::size_t n) {
    const ChaosOutcome outcome = RunChaos(seed(n), choice);
    std::string text = std::to_string(outcome.restarts) + " " + outcome.name;
    for (const std::string& line : outcome.broken) text += "\n  " + line;
    return text;
  };
  const auto take = [&](std::size_t n, const JobResult& result) {
    const bool good = result.good && result.text.find('\n') == std::string::npos;
    if (result.good) restarts += std::stoi(result.text);
    failed += good ? 0 : 1;
    const std::size_t name = result.good ? result.text.find(' ') + 1 : 0;
    if (!good || command.all) {
      std::printf("%s%s\n", good ? "" : "FAILED ", result.text.substr(name).c_str());
    }
    if (!good) {
      std::printf("  repeat: %s\n", CommandOf(seed(n), choice).c_str());
    }
    std::fflush(stdout);
  };
  RunJobs(static_cast<std::size_t>(command.seeds), command.jobs, run, take,
          [] { return g_stop != 0; });
  std::printf("%d seeds of %g s, %d restarts of the server: %d failed\n", command.seeds,
              command.seconds, restarts, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace seam
