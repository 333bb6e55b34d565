/// Short sessions over every scene, with bad networks, drives and seeds: nothing explodes, tears or
/// gets lost, and no epoch has two authorities.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/lab/experiment/jobs.h"
#include "tests/support/authority_watch.h"
#include "tests/support/physics_drift.h"
#include "tests/support/soak.h"
#include "tests/support/soak/soak_check.h"

namespace seam {
namespace soak_scenes_test {

/// Sessions in a test; SEAM_SOAK multiplies them, up to so many.
constexpr int kRuns = 20, kRunsMax = 2000;
/// Duration of each session after tick 0, s.
constexpr double kSeconds = 4;
/// A body that stops in a crash while the rest of its mechanism moves on is off by a tick's path,
/// m: at 15 m/s.
constexpr double kCrashedMax = 0.25;
/// The worst of each kind that are printed.
constexpr std::size_t kWorst = 5;

struct Network {
  const char* name;
  double torn_max_m;  ///< beyond the oracle's
};
constexpr Network kNetworks[] = {{"4g", 0.005}, {"terrible", 0.02}, {"delay=200ms", 0.02}};

/// All, or the one that SEAM_SOAK_SCENE names.
std::vector<std::string> Scenes() {
  if (const char* const one = std::getenv("SEAM_SOAK_SCENE")) return {one};
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("scenes")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

struct Session {
  ClusterConfig config;
  Network network{};
  std::string name;  ///< as seam-lab run takes it
  SoakFindings found;
  long authorities = 0;  ///< instants with two authorities, and epochs with two holders
  std::string failure;   ///< it did not run
};

/// The n-th: every scene in turn, each time over another network, and with bots every other round.
Session Plan(const std::vector<std::string>& scenes, std::size_t n) {
  Session run;
  const std::size_t scene = n % scenes.size(), round = n / scenes.size();
  run.network = kNetworks[(scene + round) % 3];
  const bool bots = (scene + round / 3) % 2 != 0;
  run.config.scene = scenes[scene];
  run.config.impair = run.network.name;
  run.config.drive = bots ? Drive::kBot : Drive::kScript;
  run.config.seed = static_cast<std::int64_t>(round) + 1;
  run.config.duration_s = kSeconds;
  run.config.players = 8;  // at most
  run.name = scenes[scene] + " --impair " + run.network.name + " --drive " +
             (bots ? "bot" : "script") + " --seed " + std::to_string(run.config.seed) +
             " --duration 4";
  return run;
}

std::string Perform(const ClusterConfig& config) {
  Cluster cluster(config);
  AuthorityWatch watch;
  PhysicsDrift drift;
  cluster.each_instant = [&] {
    watch.Look(cluster);
    drift.Look(cluster);
  };
  cluster.Run();
  const Recording& recording = cluster.recording();
  const SoakFindings found =
      CheckSoak(recording, ComputeOracle(recording, JudgeOf(recording.room)),
                [&](int peer, std::int64_t tick) { return drift.At(peer, tick); });
  std::ostringstream out;
  out << found.energy << ' ' << found.energy_sum << ' ' << found.torn_m << ' ' << found.crashed_m
      << ' ' << found.missing_s << ' ' << found.off_m << ' ' << found.compared << ' '
      << watch.several + watch.two_holders_of_an_epoch + watch.two_named_in_an_epoch << ' '
      << found.hottest;
  return out.str();
}

void Read(const JobResult& result, Session* run) {
  if (!result.good) {
    run->failure = result.text;
    return;
  }
  SoakFindings& f = run->found;
  std::istringstream in(result.text);
  in >> f.energy >> f.energy_sum >> f.torn_m >> f.crashed_m >> f.missing_s >> f.off_m >>
      f.compared >> run->authorities;
  std::getline(in >> std::ws, f.hottest);
}

/// Prints the worst and fails for each that is beyond its bar.
template <typename Value, typename Bar>
void Judge(const char* what, const char* unit, std::vector<Session> runs, const Value& value,
           const Bar& bar) {
  const auto share = [&](const Session& run) { return value(run) / bar(run); };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const Session& a, const Session& b) { return share(a) > share(b); });
  const auto beyond =
      std::find_if(runs.begin(), runs.end(), [&](const Session& run) { return !(share(run) > 1); });
  EXPECT_EQ(beyond - runs.begin(), 0) << what << ": so many of " << runs.size() << " sessions";
  std::printf("  %s: %d of %zu\n", what, static_cast<int>(beyond - runs.begin()), runs.size());
  const char* const all = std::getenv("SEAM_SOAK_ALL");  // print every one that failed
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i >= kWorst && (all == nullptr || !(share(runs[i]) > 1))) break;
    std::printf("    %8.3f %s (bar %.3f)  %s  %s\n", value(runs[i]), unit, bar(runs[i]),
                runs[i].name.c_str(), runs[i].found.hottest.c_str());
  }
}

TEST(SoakCluster, NothingExplodesTearsOrGetsLostInAnyScene) {
  const std::vector<std::string> scenes = Scenes();
  ASSERT_TRUE(scenes.size() > 10 || std::getenv("SEAM_SOAK_SCENE") != nullptr);
  std::vector<Session> runs;
  for (const int n : SoakSeeds(0, kRuns, kRunsMax)) {
    runs.push_back(Plan(scenes, static_cast<std::size_t>(n)));
  }
  const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  RunJobs(
      runs.size(), jobs, [&](std::size_t n) { return Perform(runs[n].config); },
      [&](std::size_t n, const JobResult& result) { Read(result, &runs[n]); },
      [] { return false; });
  for (const Session& run : runs) {
    EXPECT_EQ(run.failure, "") << run.name;
    EXPECT_GT(run.found.compared, 0) << run.name << ": nothing was looked at";
    EXPECT_EQ(run.authorities, 0) << run.name << ": two authorities";
  }
  const auto one = [](const Session&) { return 1.0; };
  Judge(
      "exploded", "x", runs, [](const Session& r) { return r.found.energy; }, one);
  Judge(
      "exploded, sum", "x", runs, [](const Session& r) { return r.found.energy_sum; }, one);
  Judge(
      "torn", "m", runs, [](const Session& r) { return r.found.torn_m; },
      [](const Session& r) { return r.network.torn_max_m; });
  Judge(
      "opened by the engine in a crash", "m", runs,
      [](const Session& r) { return r.found.crashed_m; },
      [](const Session&) { return kCrashedMax; });
  Judge(
      "missing", "s", runs, [](const Session& r) { return r.found.missing_s; }, one);
  Judge(
      "off", "m", runs, [](const Session& r) { return r.found.off_m; },
      [](const Session&) { return 20.0; });
}

}  // namespace soak_scenes_test
}  // namespace seam
