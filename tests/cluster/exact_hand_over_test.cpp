/// A mechanism that changes hands begins at its successor with its holder's last state.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "client/embed/cluster.h"
#include "common/measure/handover_list.h"
#include "tests/cluster/rewritten_states.h"
#include "tests/support/path/rewriting_net.h"
#include "tests/support/pendulums.h"
#include "tests/support/soak.h"

namespace seam {
namespace exact_hand_over_test {

std::vector<HandOverSeen> HandOvers(const ClusterConfig& config) {
  const Recording recording = RunCluster(config);
  const Scene scene = ParseScene(recording.room.scene_text, recording.room.scene_name + ".toml");
  const RevisionHistory revisions(scene, recording);
  return ListHandOvers(recording, &revisions);
}

TEST(ExactHandOver, TheSuccessorBeginsAtTheHoldersLastState) {
  for (const char* rule : {"retrospect", "rollback"}) {
    for (const int seed : SoakSeeds(1, 2)) {
      ClusterConfig config;
      config.scene = "relay";
      config.impair = "4g";
      config.reconcile = rule;
      config.seed = seed;
      config.show_age_ticks = 0;  // views of different ages are apart
      const std::vector<HandOverSeen> changes = HandOvers(config);
      ASSERT_GT(changes.size(), 6u) << rule << " seed " << seed;
      EXPECT_LE(HandOverQuantile(changes, &HandOverSeen::gap_m, 0.95), 0.02) << rule << seed;
      EXPECT_LE(HandOverQuantile(changes, &HandOverSeen::dv_mps, 0.95), 0.1) << rule << seed;
    }
  }
}

/// Nine of ten States are lost: the last received one is a third of a second old.
TEST(ExactHandOver, TheLastExactStateAloneIsEnough) {
  ClusterConfig config;
  config.scene = "pendulums.toml";
  config.scene_text = Pendulums(4);
  config.impair = "delay=40ms";
  config.smooth_rate = 0;  // the physics, not what is shown of it
  config.client_net = [](std::size_t, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    return std::make_unique<RewritingNet>(std::move(net),
                                          [n = 0](std::int64_t, Bytes* message) mutable {
                                            if (!std::holds_alternative<States>(Decode(*message)))
                                              return true;
                                            return ++n % 10 == 0;
                                          });
  };
  const std::vector<HandOverSeen> changes = HandOvers(config);
  ASSERT_GT(changes.size(), 8u);
  SCOPED_TRACE(FormatHandOvers(changes));
  EXPECT_LE(HandOverQuantile(changes, &HandOverSeen::gap_m, 0.95), 0.02);
  EXPECT_LE(HandOverQuantile(changes, &HandOverSeen::dv_mps, 0.95), 0.1);
}

TEST(ExactHandOver, ExactStatesFromANonHolderAreIgnored) {
  ClusterConfig config;
  config.scene = "pendulums.toml";
  config.scene_text = Pendulums(2);
  config.impair = "perfect";
  int forged = 0;
  SentStates sent;
  config.client_net = [&](std::size_t client, std::unique_ptr<Net> net) -> std::unique_ptr<Net> {
    if (client != 0) return net;
    return std::make_unique<RewritingNet>(std::move(net), [&](std::int64_t, Bytes* message) {
      const States* const told = sent.In(*message);
      if (told == nullptr) return true;
      const States& states = *told;
      ExactStates exact;
      exact.tick = states.tick;
      exact.revision = states.revision;
      exact.id = {states.id.at(0)};
      exact.epoch = {states.epoch.at(0) + 1};  // as if it had been told to let go
      exact.x = exact.y = {3};
      exact.angle = exact.vx = exact.vy = exact.spin = {0};
      *message = Encode(exact);
      ++forged;
      return true;
    });
  };
  Cluster cluster(config);
  cluster.RunToTick(30);
  EXPECT_GT(forged, 5);
  EXPECT_GE(cluster.server().stats().dropped_right, forged - 3);
  const World& world = cluster.server().replica().world();
  for (int body = 0; body < world.body_count(); ++body) {
    EXPECT_GT((world.Read(body).position - Vec2(3, 3)).norm(), 0.5f);
  }
}

}  // namespace exact_hand_over_test
}  // namespace seam
