/// scenes/relay.toml serves its purpose: many hand-overs in a world so orderly that each jump is
/// caused by the method.

#include <gtest/gtest.h>

#include "common/measure/measure.h"
#include "tests/lab/session.h"

namespace seam {
namespace relay_test {

TEST(Relay, HandsOverRepeatedlyInAnOrderlyWorld) {
  SessionSettings settings;
  settings.scene = "scenes/relay.toml";
  const Recording run = RunCluster(Configure(settings));
  const Oracle oracle = ComputeOracle(run);
  const Measures m = Measure(run, oracle);
  EXPECT_GE(m.handovers, 8);
  EXPECT_TRUE(m.handover_gap_m && m.handover_dv_mps);
  EXPECT_LT(ErrorFloor(run, oracle), 1e-4);
  // Nothing comes to rest, and nothing leaves its shelf.
  const BodyState& alone = oracle.ticks.back()[0];
  EXPECT_NEAR(std::abs(alone.velocity.x()), 5, 0.01);
  EXPECT_NEAR(alone.position.y(), 6.5, 0.02);
}

TEST(Relay, APerfectNetworkHandsOverWithoutAGap) {
  SessionSettings settings;
  settings.scene = "scenes/relay.toml";
  settings.impair = "perfect";
  settings.duration_s = 5;
  const Recording run = RunCluster(Configure(settings));
  const Measures m = Measure(run, ComputeOracle(run));
  ASSERT_GE(m.handovers, 1);
  EXPECT_LT(m.handover_gap_m.value(), 0.01);
}

}  // namespace relay_test
}  // namespace seam
