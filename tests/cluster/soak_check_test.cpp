/// What the soak excuses of an open joint, and what it does not.

#include "tests/support/soak_check.h"

#include <gtest/gtest.h>

#include "common/measure/joint_drift.h"
#include "tests/lab/cluster.h"

namespace seam {
namespace {

/// Two cars that have crashed, by their scripts, as the oracle had it.
class SoakCheck : public ::testing::Test {
 protected:
  SoakCheck() {
    ClusterConfig config;
    config.scene = "headon";
    config.impair = "demo";
    config.drive = Drive::kScript;
    config.duration_s = 4;
    Cluster cluster(config);
    cluster.Run();
    recording_ = cluster.recording();
    oracle_ = ComputeOracle(recording_, JudgeOf(recording_.room));
    const World& world = cluster.server().replica().world();
    const JointMeter joints(world.scene(), world.composition());
    double worst = 0;
    for (std::size_t row = 0; row < oracle_.ticks.size(); ++row) {
      const std::int64_t tick = oracle_.first_tick + static_cast<std::int64_t>(row);
      const double drift = joints.Worst(oracle_.ticks[row], tick);
      if (drift > worst) crash_ = tick;
      worst = std::max(worst, drift);
    }
    EXPECT_GT(worst, 0.005) << "the engine opens joints in this crash";
  }

  /// With a wheel shown 1 m off in one client's view of `ticks` ticks from there.
  SoakFindings Torn(std::int64_t tick, int ticks, double engine) const {
    Recording torn = recording_;
    for (int i = 0; i < ticks; ++i) {
      View& view = torn.views.at(1).at(tick + i);
      view.x.at(1) += 1;  // across its spring
    }
    return CheckSoak(torn, oracle_, [engine](int, std::int64_t) { return engine; });
  }

  Recording recording_;
  Oracle oracle_;
  std::int64_t crash_ = 0;
};

TEST_F(SoakCheck, ViewsThatAreNotTornAreFoundSo) { EXPECT_LT(Torn(crash_, 0, 0).torn_m, 0.02); }

TEST_F(SoakCheck, AnOpenJointIsTornUnlessTheEngineOpenedIt) {
  EXPECT_GT(Torn(crash_, 1, 0).torn_m, 0.5);
  EXPECT_LT(Torn(crash_, 1, 2).torn_m, 0.02);
  EXPECT_GT(Torn(crash_, 1, 2).crashed_m, 0.5);
}

TEST_F(SoakCheck, TheEngineIsNoExcuseAwayFromACrashOrForLong) {
  EXPECT_GT(Torn(crash_ - 40, 1, 2).torn_m, 0.5);
  EXPECT_GT(Torn(crash_, 12, 2).torn_m, 0.5);
}

}  // namespace
}  // namespace seam
