/// Tests which open joints the soak check accepts.

#include "tests/support/soak/soak_check.h"

#include <gtest/gtest.h>

#include "client/embed/cluster.h"

namespace seam {
namespace soak_check_test {

/// Two cars, and an oracle whose joints are open for a tick.
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
    // Solvers open joints in a crash by different amounts: here the oracle's is opened by hand.
    crash_ = recording_.last_tick / 2;
    const auto row = static_cast<std::size_t>(crash_ - oracle_.first_tick);
    oracle_.ticks[row][1].position.x() += 0.01f;
  }

  /// Findings with a wheel displayed 1 m off in one client's view for `ticks` ticks from there.
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

TEST_F(SoakCheck, ViewsWithoutOpenJointsPass) { EXPECT_LT(Torn(crash_, 0, 0).torn_m, 0.02); }

TEST_F(SoakCheck, AnOpenJointFailsUnlessTheEngineOpenedIt) {
  EXPECT_GT(Torn(crash_, 1, 0).torn_m, 0.5);
  EXPECT_LT(Torn(crash_, 1, 2).torn_m, 0.02);
  EXPECT_GT(Torn(crash_, 1, 2).crashed_m, 0.5);
}

TEST_F(SoakCheck, TheEngineExcusesNothingOutsideACrashOrForLong) {
  EXPECT_GT(Torn(crash_ - 40, 1, 2).torn_m, 0.5);
  EXPECT_GT(Torn(crash_, 12, 2).torn_m, 0.5);
}

}  // namespace soak_check_test
}  // namespace seam
