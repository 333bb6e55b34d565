#include "tests/lab/chaos/chaos.h"

#include <algorithm>
#include <filesystem>

#include "tests/lab/chaos/kept_log.h"
#include "tests/support/soak/invariants.h"

namespace seam {
namespace {

/// Most players of a session, and most parts: larger rooms take minutes.
constexpr std::size_t kPlayersMost = 8, kPartsMost = 450;

std::vector<std::string> SmallScenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const Scene scene = LoadScene(entry.path());
    const bool small = scene.players.size() <= kPlayersMost && scene.parts.size() <= kPartsMost;
    if (small) names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// At the end, after the calm: all play, and all are made of the same.
void LookAtTheEnd(Cluster& cluster, std::vector<std::string>* broken) {
  const Replica& server = cluster.server().replica();
  for (int c = 0; c < cluster.client_count(); ++c) {
    const Client* const client = cluster.client(c);
    const std::string who = "at the end: client " + std::to_string(c);
    if (client == nullptr || !client->running()) {
      const std::string why = client == nullptr ? "its process is gone" : client->fatal();
      broken->push_back(who + " does not play: " + (why.empty() ? "it joins" : why));
    } else if (client->replica()->revision() == server.revision() &&
               client->replica()->world().composition().hash != server.world().composition().hash) {
      broken->push_back(who + " has another composition");
    }
  }
}

}  // namespace

ChaosOutcome RunChaos(std::uint64_t seed, const ChaosChoice& choice) {
  FaultChoice faulty;
  faulty.scenes = choice.scenes.empty() ? SmallScenes() : choice.scenes;
  faulty.seconds = choice.seconds;
  faulty.players = static_cast<int>(kPlayersMost);
  FaultPlan plan = DrawFaults(seed, faulty);
  AddServerFaults(seed, choice.seconds, &plan);
  ChaosOutcome outcome;
  outcome.name = plan.name;
  KeptLog kept;
  plan.config.recorder = &kept;
  plan.config.publish = Publish::kNone;
  FaultRunner faults(plan);
  faults.restart_server = [&](Cluster& cluster, std::int64_t down_us) {
    const bool restarted = kept.Restart(cluster, down_us, &outcome.broken);
    outcome.restarts += restarted ? 1 : 0;
    return restarted;
  };
  Cluster cluster(faults.Config());
  Invariants invariants(cluster, faults, plan.config.mode == "strict");
  cluster.each_instant = [&] {
    kept.Look(cluster);
    invariants.Look();
    faults.Act(cluster);
  };
  cluster.Run();
  for (const auto& [what, broken] : invariants.broken()) {
    outcome.broken.push_back(what + "; " + std::to_string(broken.times) + " times; " +
                             broken.first);
  }
  LookAtTheEnd(cluster, &outcome.broken);
  return outcome;
}

}  // namespace seam
