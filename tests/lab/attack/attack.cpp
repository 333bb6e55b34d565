#include "tests/lab/attack/attack.h"

#include <algorithm>
#include <utility>

#include "common/scene/part_rules.h"
#include "server/rules/rules.h"
#include "tests/lab/attack/cheat.h"
#include "tests/lab/session.h"
#include "tests/support/soak/fault_runner.h"

namespace seam {
namespace {

/// Health lost by parts of all owners but the first player's.
float Hurt(const Cluster& cluster, const Rules& rules) {
  float lost = 0;
  const Scene& scene = cluster.scene();
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const Part& part = scene.parts[p];
    if (part.rules->health <= 0 || part.owner <= 0) continue;
    const MetaKey key{kMetaPart, static_cast<std::int32_t>(p), kMetaHealth};
    lost += std::max(0.0f, part.rules->health - rules.metadata().Get(key));
  }
  return lost;
}

}  // namespace

AttackOutcome RunAttack(ClusterConfig config, const std::string& attack,
                        const std::vector<Fault>& faults) {
  const Scene scene = config.scene_text.empty() ? LoadScene("scenes/" + config.scene + ".toml")
                                                : ParseScene(config.scene_text, config.scene);
  Cheat cheat(attack, scene);
  config.trust = TrustMode::kAct;
  FaultPlan plan;
  plan.config = std::move(config);
  plan.faults = faults;
  FaultRunner runner(plan);
  config = runner.Config();
  config.client_net = [&, faulty = config.client_net](std::size_t client,
                                                      std::unique_ptr<Net> net) {
    net = faulty(client, std::move(net));
    if (client != 0 || attack == "none") return net;
    return cheat.Around(std::move(net));
  };
  Cluster cluster(config);
  AttackOutcome outcome;
  std::int64_t looked = -1;
  cluster.each_instant = [&] {
    runner.Act(cluster);
    const Server& server = cluster.server();
    if (!server.started() || server.tick() == looked) return;
    looked = server.tick();
    for (int p = 0; p < static_cast<int>(scene.players.size()); ++p) {
      int& highest = p == 0 ? outcome.step : outcome.others_step;
      highest = std::max(highest, static_cast<int>(server.ladder().step(p)));
    }
    outcome.highest_score = std::max(outcome.highest_score, server.ladder().score(0));
    const bool acted = !server.ladder().MayHold(0, server.tick()) || cluster.client(0) == nullptr ||
                       server.player_count() < static_cast<int>(scene.players.size());
    if (acted && cheat.lies() > 0 && outcome.acted_tick < 0) outcome.acted_tick = looked;
  };
  cluster.Run();
  RequireScripts(cluster.server());
  const Server& server = cluster.server();
  outcome.lies = cheat.lies();
  outcome.first_tick = cheat.first_tick();
  outcome.refused = server.stats().dropped_implausible;
  if (const Rules* const rules = server.rules()) {
    outcome.won = rules->metadata().Get({kMetaPlayer, 0, kMetaScore});
    outcome.hurt = Hurt(cluster, *rules);
  }
  for (const Joint& joint : server.replica().world().scene().joints) outcome.broken += joint.gone;
  return outcome;
}

}  // namespace seam
