/// Rebound, rest, hand-over and cost in recordings made by hand with known answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/measure/parts.h"
#include "tests/support/made_recording.h"

namespace seam {
namespace measure_events_test {

// ---- rebound

/// Struck from rest to `speed` at tick 64, by an oracle or (`late` ticks after) by a run.
Path Struck(double speed, std::int64_t late = 0) {
  return [=](std::int64_t tick) {
    return State(0, 0, tick >= 64 + late ? speed : 0, tick >= 64 + late ? 0.5 * speed : 0);
  };
}

TEST(Rebound, IsTheShareOfTheMomentumThatArrived) {
  const Oracle oracle = MakeOracle(200, Struck(4));
  const std::map<PartId, double> masses = {{3, 2.5}, {7, 10}};
  for (const double share : {1.0, 0.0, 0.5, 1.5, -0.25}) {
    const auto rebound = Rebound(MakeRecording(2, 200, Struck(4 * share)), oracle, masses, 10);
    ASSERT_TRUE(rebound.has_value());
    EXPECT_DOUBLE_EQ(*rebound, share);
  }
}

TEST(Rebound, ALateImpactCountsInFull) {
  const Oracle oracle = MakeOracle(200, Struck(4));
  const auto rebound = Rebound(MakeRecording(1, 200, Struck(4, 13)), oracle, {{3, 1}}, 10);
  EXPECT_DOUBLE_EQ(rebound.value(), 1);
}

TEST(Rebound, IsReadFromThePeerWithAuthority) {
  Recording run = MakeRecording(2, 200, Struck(4));
  for (auto& [tick, view] : run.views[0]) {  // the server is a secondary with wrong ideas
    view.role[0] = kRoleSecondary;
    view.vx[0] = -9;
  }
  for (auto& [tick, view] : run.views[1]) view.role[0] = kRoleAuthority;
  EXPECT_DOUBLE_EQ(Rebound(run, MakeOracle(200, Struck(4)), {{3, 1}}, 10).value(), 1);
}

TEST(Rebound, OnlyTheChangeCountsNotTheMotionBefore) {
  const auto moving = [](double before, double after) {
    return [=](std::int64_t tick) { return State(0, 0, tick >= 64 ? after : before, 0); };
  };
  const Oracle oracle = MakeOracle(200, moving(-8, 2));
  const Recording run = MakeRecording(1, 200, moving(-8, -3));
  EXPECT_DOUBLE_EQ(Rebound(run, oracle, {{3, 1}}, 0).value(), 0.5);
}

TEST(Rebound, IgnoresImpactsBeforeTheWatchedTick) {
  const Path twice = [](std::int64_t tick) {
    return State(0, 0, tick < 20 ? 0 : tick < 100 ? 50 : 54, 0);
  };
  const Path half = [](std::int64_t tick) {
    return State(0, 0, tick < 20 ? 0 : tick < 100 ? 50 : 52, 0);
  };
  const Oracle oracle = MakeOracle(200, twice);
  EXPECT_DOUBLE_EQ(Rebound(MakeRecording(1, 200, half), oracle, {{3, 1}}, 60).value(), 0.5);
}

TEST(Rebound, IsUnknownWithoutACollisionOrItsEnd) {
  const Oracle still = MakeOracle(200, Struck(0));
  EXPECT_FALSE(Rebound(MakeRecording(1, 200, Struck(0)), still, {{3, 1}}, 0).has_value());
  const Oracle oracle = MakeOracle(200, Struck(4));
  EXPECT_FALSE(Rebound(MakeRecording(1, 70, Struck(4)), oracle, {{3, 1}}, 0).has_value());
  EXPECT_FALSE(Rebound(MakeRecording(1, 200, Struck(4)), oracle, {{99, 1}}, 0).has_value());
  EXPECT_FALSE(Rebound(MakeRecording(1, 200, Struck(4)), oracle, {}, 0).has_value());
  const Oracle short_oracle = MakeOracle(80, Struck(4));
  EXPECT_FALSE(Rebound(MakeRecording(1, 200, Struck(4)), short_oracle, {{3, 1}}, 0).has_value());
}

// ---- rest

/// Slides until `stop`, then stands.
Path Stopping(std::int64_t stop) {
  return [=](std::int64_t tick) {
    return State(static_cast<double>(std::min(tick, stop)) * kH, 0, tick < stop ? 1 : 0, 0);
  };
}

TEST(Rest, CountsTicksFromTheOraclesRestUntilAllPeersAgreeToTheBit) {
  const Oracle oracle = MakeOracle(300, Stopping(100));
  EXPECT_EQ(RestTicks(MakeRecording(3, 300, Stopping(100)), oracle).value(), 0);
  Recording late = MakeRecording(3, 300, Stopping(100));
  for (std::int64_t tick = 0; tick < 130; ++tick) {
    float& x = late.views[2][tick].x[1];
    x = std::nextafter(x, 0.0f);  // one bit, on one peer
  }
  EXPECT_EQ(RestTicks(late, oracle).value(), 30);
}

TEST(Rest, AgreementThatDoesNotLastDoesNotCount) {
  const Oracle oracle = MakeOracle(300, Stopping(100));
  Recording run = MakeRecording(2, 300, Stopping(100));
  run.views[1][250].angle[0] = 1e-9f;
  EXPECT_EQ(RestTicks(run, oracle).value(), 151);
  run.views[1][300].angle[0] = 1e-9f;
  EXPECT_FALSE(RestTicks(run, oracle).has_value());
}

TEST(Rest, IsUnknownIfTheOracleNeverRestsOrThereIsOneView) {
  EXPECT_FALSE(RestTicks(MakeRecording(2, 300, Moving(1)), MakeOracle(300, Moving(1))).has_value());
  const Oracle oracle = MakeOracle(300, Stopping(100));
  EXPECT_FALSE(RestTicks(MakeRecording(1, 300, Stopping(100)), oracle).has_value());
  EXPECT_FALSE(RestTicks(MakeRecording(2, 300, Stopping(290)), MakeOracle(300, Stopping(290)))
                   .has_value());  // too short to be for good
}

// ---- hand-over

TEST(Handover, MeasuresTheJumpBeyondTheMotionAndCountsMechanismsOnce) {
  Recording run = MakeRecording(2, 100, Moving(2));
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      if (tick >= 50) view.authority[0] = view.authority[1] = 1;  // both bodies at tick 50
      if (tick >= 70) view.authority[0] = 0;
    }
  }
  for (auto& [tick, view] : run.views[1]) {
    if (tick >= 50) view.y[0] += 0.25f;
    if (tick >= 80) view.y[0] += 4;  // a jump, but not at a hand-over
  }
  Measures m;
  MeasureHandover(run, {{3, 0}, {7, 0}}, &m);
  EXPECT_EQ(m.handovers, 2);
  EXPECT_DOUBLE_EQ(m.handover_jump_m, 0.25);
  Measures apart;
  MeasureHandover(run, {{3, 0}, {7, 1}}, &apart);
  EXPECT_EQ(apart.handovers, 3);
  EXPECT_EQ(Measure(run, MakeOracle(100, Moving(2))).handovers, 3);  // no scene: every body one
}

// ---- cost

Stats MakeStats(int peer, std::int64_t tick, std::int64_t in, std::int64_t out, std::int64_t cpu) {
  Stats stats;
  stats.peer = peer;
  stats.tick = tick;
  stats.bytes_in = in;
  stats.bytes_out = out;
  stats.cpu_us = cpu;
  return stats;
}

TEST(Cost, IsPerSimulatedSecondOfClientsForBytesAndOfAllPeersForTime) {
  Recording run = MakeRecording(3, 10, Moving(2));
  run.stats[0] = {MakeStats(0, 0, 0, 0, 1000), MakeStats(0, 10 * kHz, 1 << 20, 1 << 20, 31'000)};
  run.stats[1] = {MakeStats(1, 0, 500, 500, 0), MakeStats(1, 5 * kHz, 1500, 2500, 5'000),
                  MakeStats(1, 10 * kHz, 10'500, 10'500, 10'000)};
  run.stats[2] = {MakeStats(2, 2 * kHz, 0, 0, 0), MakeStats(2, 4 * kHz, 1000, 5000, 4'000)};
  const Measures m = Measure(run, MakeOracle(10, Moving(2)));
  EXPECT_DOUBLE_EQ(m.bytes_per_s, (2000.0 + 3000.0) / 2);
  EXPECT_DOUBLE_EQ(m.cpu_us_per_s, (3000.0 + 1000.0 + 2000.0) / 3);
}

TEST(Cost, WaitingAndRestartsAreLeftOut) {
  Recording run = MakeRecording(1, 10, Moving(2));
  run.stats[1] = {MakeStats(1, 0, 0, 0, 0), MakeStats(1, 0, 90'000, 0, 0),  // waits for players
                  MakeStats(1, kHz, 91'000, 0, 0), MakeStats(1, 2 * kHz, 10, 0, 0),
                  MakeStats(1, 3 * kHz, 1010, 0, 0)};
  EXPECT_DOUBLE_EQ(Measure(run, MakeOracle(10, Moving(2))).bytes_per_s, 1000);
}

}  // namespace measure_events_test
}  // namespace seam
