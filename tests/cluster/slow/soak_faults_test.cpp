/// Sessions with every kind of fault: each seed draws a scene, a method, a network and the faults
/// of each client. The invariants hold at every virtual instant.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/lab/experiment/jobs.h"
#include "tests/support/soak.h"
#include "tests/support/soak/fault_trace.h"
#include "tests/support/soak/invariants.h"

namespace seam {
namespace soak_faults_test {

/// Sessions in a test, and of how many s each; a soak has more, of a minute each.
constexpr int kRuns = 20, kRunsMax = 2000;
constexpr int kNarrowRuns = 8;
constexpr double kSeconds = 20, kSecondsSoak = 60;

/// Most players of a session; and bodies above which a room is narrow.
constexpr std::size_t kPlayersMost = 8, kPartsMost = 450;

std::vector<std::string> Scenes(bool large) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = LoadScene(entry.path());
    const bool is = scene.players.size() > kPlayersMost || scene.parts.size() > kPartsMost;
    if (large || !is) names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

int FromEnvironment(const char* name, int otherwise) {
  const char* const value = std::getenv(name);
  return value == nullptr ? otherwise : std::atoi(value);
}

/// Prints the events of a session.
class EventPrinter : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView message) override {
    const AnyMessage any = Decode(message);
    const Event* const event = std::get_if<Event>(&any);
    if (event == nullptr) return;
    std::printf("  tick %lld: %s\n", static_cast<long long>(event->tick), event->text.c_str());
  }
};

/// Returns the broken invariants, a line each; the last line is for the reader.
std::string Perform(const FaultPlan& plan) {
  FaultRunner faults(plan);
  EventPrinter printer;
  ClusterConfig config = faults.Config();
  if (std::getenv("SEAM_SOAK_TRACE") != nullptr) config.recorder = &printer;
  Cluster cluster(config);
  Invariants invariants(cluster, faults, plan.config.mode == "strict");
  const bool traces = std::getenv("SEAM_SOAK_TRACE") != nullptr;
  std::optional<FaultTrace> trace;
  if (traces) trace.emplace(plan);
  cluster.each_instant = [&] {
    if (traces) trace->Look(cluster);
    invariants.Look();
    faults.Act(cluster);
  };
  cluster.Run();
  if (traces) std::fflush(stdout);
  std::ostringstream out;
  for (const auto& [what, broken] : invariants.broken()) {
    out << what << "; " << broken.times << " times; " << broken.first << "\n";
  }
  out << plan.name << "; looked " << invariants.compared() << ", rest " << invariants.reached_rest()
      << ", " << invariants.fastest() << " m/s;";
  for (const auto& [queue, most] : invariants.queues()) out << " " << queue << " " << most << ",";
  out << " " << (cluster.server_cpu_us() + cluster.client_cpu_us()) * 1e-6 << " s";
  return out.str();
}

/// Returns SEAM_SEEDS seeds from SEAM_SEED on, or those of the soak.
std::vector<int> Seeds(int count) {
  if (std::getenv("SEAM_SEED") == nullptr && std::getenv("SEAM_SEEDS") == nullptr) {
    return SoakSeeds(1, count, kRunsMax);
  }
  std::vector<int> seeds(static_cast<std::size_t>(FromEnvironment("SEAM_SEEDS", 1)));
  std::iota(seeds.begin(), seeds.end(), FromEnvironment("SEAM_SEED", 1));
  return seeds;
}

void RunSeeds(bool narrow, int count, const char* filter) {
  const bool soak = Soak(count) > kRuns;
  const std::vector<int> seeds = Seeds(count);
  FaultChoice choice;
  choice.scenes = Scenes(narrow);
  choice.seconds =
      FromEnvironment("SEAM_SECONDS", static_cast<int>(soak ? kSecondsSoak : kSeconds));
  choice.players = static_cast<int>(kPlayersMost);
  choice.narrow = narrow;
  const auto plan = [&](std::size_t n) {
    return DrawFaults(static_cast<std::uint64_t>(seeds[n]), choice);
  };
  int failed = 0;
  RunJobs(
      seeds.size(), FromEnvironment("SEAM_JOBS", 2),
      [&](std::size_t n) { return Perform(plan(n)); },
      [&](std::size_t n, const JobResult& result) {
        const std::size_t end = result.text.rfind('\n');
        const bool good = result.good && end == std::string::npos;
        const bool all = std::getenv("SEAM_SOAK_ALL") != nullptr;
        if (!good || all) std::printf("%s%s\n", good ? "" : "FAILED ", result.text.c_str());
        if (!result.good) std::printf("  %s\n", plan(n).name.c_str());
        if (!good)
          std::printf("  repeat: SEAM_SEED=%d SEAM_SECONDS=%.0f seam-tests --gtest_filter='%s'\n",
                      seeds[n], choice.seconds, filter);
        std::fflush(stdout);
        failed += good ? 0 : 1;
      },
      [] { return false; });
  EXPECT_EQ(failed, 0) << "of " << seeds.size() << " seeds";
}

TEST(SoakFaultsCluster, EverySeedKeepsItsInvariantsAtEveryInstant) {
  RunSeeds(false, kRuns, "SoakFaults*");
}

/// The invariants also hold with the omissions and delays of large rooms.
TEST(SoakNarrowCluster, EverySeedKeepsItsInvariantsInLargeRoomsAndNarrowOnes) {
  RunSeeds(true, kNarrowRuns, "SoakNarrow*");
}

}  // namespace soak_faults_test
}  // namespace seam
