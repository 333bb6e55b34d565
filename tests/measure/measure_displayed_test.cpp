/// Penetration, joint drift, energy gain, jitter at rest and the two sides of a hand-over, in
/// recordings made by hand with known answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/measure/parts.h"
#include "tests/support/made_recording.h"

namespace seam {
namespace measure_displayed_test {

/// Bodies 3 and 7 of a made recording, as boxes of 1 kg, and anchored things out of the way. 3 is
/// above a floor at y = 0, which does not reach to where 7 stands.
const char* const kScene = R"(
gravity = [0, -10]
[[part]]
name = "floor"
chain = [[-2, 0], [100, 0]]
[[part]]
name = "far"
box = [1, 1]
position = [50, 50]
anchored = true
repeat = {count = 2, step = [2, 0]}
[[part]]
name = "three"
box = [1, 1]
position = [0, 1]
[[part]]
name = "farther"
box = [1, 1]
position = [50, 60]
anchored = true
repeat = {count = 3, step = [2, 0]}
[[part]]
name = "seven"
box = [1, 1]
position = [-5, 0]
[[joint]]
name = "rod"
kind = "distance"
a = "farther.0"
b = "seven"
)";

Recording WithScene(Recording recording, const std::string& text = kScene) {
  recording.room.scene_name = "made";
  recording.room.scene_text = text;
  return recording;
}

/// Body 3 stands still, `lift` above where it lies on the floor.
Path Lying(double lift = 0) {
  return [=](std::int64_t) { return State(0, 0.5 + lift); };
}

TEST(Displayed, PenetrationIsTheDeepestThatAnyPeerShows) {
  Recording run = WithScene(MakeRecording(2, 200, Lying()));
  const Oracle oracle = MakeOracle(200, Lying());
  EXPECT_EQ(Measure(run, oracle).penetration_m.value(), 0);
  // 64 Hz: every seventh tick is looked at.
  run.views[1][70].y[0] -= 0.125f;
  run.views[1][77].y[0] -= 0.0625f;
  run.views[0][84].y[0] -= 0.03125f;
  const Measures m = Measure(run, oracle);
  EXPECT_DOUBLE_EQ(m.penetration_m.value(), 0.125);
  EXPECT_EQ(m.oracle_penetration_m.value(), 0);
  const Measures oracles = Measure(run, MakeOracle(200, Lying(-0.25)));
  EXPECT_DOUBLE_EQ(oracles.oracle_penetration_m.value(), 0.25);
  EXPECT_DOUBLE_EQ(oracles.penetration_m.value(), 0.125);
}

TEST(Displayed, PenetrationLastingATenthOfASecondIsNeverMissed) {
  Recording run = WithScene(MakeRecording(1, 200, Lying()));
  for (std::int64_t begin = 10; begin < 24; ++begin) {
    Recording shown = run;
    for (std::int64_t tick = begin; tick < begin + 7; ++tick) {
      shown.views[0][tick].y[0] -= 0.125f;
    }
    EXPECT_DOUBLE_EQ(Measure(shown, MakeOracle(200, Lying())).penetration_m.value(), 0.125);
  }
}

TEST(Displayed, JointDriftIsTheWorstOfAnyTick) {
  Recording run = WithScene(MakeRecording(2, 100, Lying()));
  const double length = std::hypot(55.0, 60.0);  // from farther.0 to seven
  EXPECT_NEAR(Measure(run, MakeOracle(100, Lying())).joint_drift_m.value(), 0, 1e-5);
  run.views[1][33].x[1] -= 0.5f;
  const Measures m = Measure(run, MakeOracle(100, Lying()));
  EXPECT_NEAR(m.joint_drift_m.value(), std::hypot(55.5, 60.0) - length, 1e-5);
  EXPECT_NEAR(m.oracle_joint_drift_m.value(), 0, 1e-5);
}

TEST(Displayed, EnergyGainIsTheExcessOverTheOraclesMaximumNearby) {
  Recording run = WithScene(MakeRecording(2, 200, Lying()));
  const Oracle oracle = MakeOracle(200, Lying());
  EXPECT_EQ(Measure(run, oracle).energy_gain_j.value(), 0);
  run.views[1][50].vx[0] = 3;
  run.views[1][50].vy[0] = -4;     // 12.5 J of speed
  run.views[0][60].y[0] += 0.25f;  // 2.5 J of height
  EXPECT_NEAR(Measure(run, oracle).energy_gain_j.value(), 12.5, 1e-9);
  run.views[1][50].vx[0] = run.views[1][50].vy[0] = 0;
  EXPECT_NEAR(Measure(run, oracle).energy_gain_j.value(), 2.5, 1e-9);
  run.views[0][60].y[0] -= 0.5f;  // less than the oracle is no gain
  EXPECT_EQ(Measure(run, oracle).energy_gain_j.value(), 0);
}

TEST(Displayed, ALateImpactOrInputIsNoEnergyGainButAnEndlessImpactIs) {
  // 8 J at tick 0, lost at tick 64 in the oracle; a run shows it later.
  const auto stopped_at = [](std::int64_t stop) {
    return [=](std::int64_t tick) { return State(0, 0.5, tick < stop ? 4 : 0, 0); };
  };
  const Oracle oracle = MakeOracle(200, stopped_at(64));
  const auto gain = [&](std::int64_t stop) {
    return Measure(WithScene(MakeRecording(1, 200, stopped_at(stop))), oracle).energy_gain_j;
  };
  EXPECT_EQ(gain(64).value(), 0);
  EXPECT_EQ(gain(64 + 32).value(), 0);  // half a second
  EXPECT_NEAR(gain(64 + 33).value(), 8, 1e-9);
  // An input that gives 8 J is the oracle's too.
  const auto started_at = [](std::int64_t start) {
    return [=](std::int64_t tick) { return State(0, 0.5, tick < start ? 0 : 4, 0); };
  };
  EXPECT_EQ(
      Measure(WithScene(MakeRecording(1, 200, started_at(100))), MakeOracle(200, started_at(105)))
          .energy_gain_j.value(),
      0);
}

TEST(Displayed, ReportsNothingWithoutASceneItsBodiesOrItsJoints) {
  const Oracle oracle = MakeOracle(100, Lying());
  const Measures none = Measure(MakeRecording(1, 100, Lying()), oracle);
  EXPECT_FALSE(none.penetration_m || none.joint_drift_m || none.energy_gain_j);
  const std::string scene = kScene;
  const std::string jointless = scene.substr(0, scene.find("[[joint]]"));
  const Measures no_joints = Measure(WithScene(MakeRecording(1, 100, Lying()), jointless), oracle);
  EXPECT_TRUE(no_joints.penetration_m && no_joints.energy_gain_j);
  EXPECT_FALSE(no_joints.joint_drift_m || no_joints.oracle_joint_drift_m);
  Recording partial = WithScene(MakeRecording(1, 100, Lying()));
  for (auto& [tick, view] : partial.views[0]) view.id[1] = 9;
  const Measures others = Measure(partial, oracle);
  EXPECT_FALSE(others.penetration_m || others.joint_drift_m || others.energy_gain_j);
  EXPECT_TRUE(others.oracle_penetration_m.has_value());
}

// ---- jitter at rest

/// Slides until `stop`, then stands.
Path Stopping(std::int64_t stop) {
  return [=](std::int64_t tick) {
    return State(static_cast<double>(std::min(tick, stop)) * kH, 0, tick < stop ? 1 : 0, 0);
  };
}

TEST(RestJitter, IsTheRootMeanSquareSpeedShownHalfASecondAfterTheOraclesRest) {
  const Oracle oracle = MakeOracle(300, Stopping(100));  // rests from tick 100: from 132 on
  EXPECT_EQ(RestJitter(MakeRecording(2, 300, Stopping(100)), oracle).value(), 0);
  EXPECT_EQ(RestJitter(MakeRecording(2, 300, Stopping(132)), oracle).value(), 0);  // late, calm
  Recording run = MakeRecording(1, 300, Stopping(100));
  for (auto& [tick, view] : run.views[0]) {
    if (tick % 2 == 0) view.y[0] += 0.0009765625f;  // to and fro by 1/1024 m each tick
  }
  // 1/16 m/s of one body of two.
  EXPECT_DOUBLE_EQ(RestJitter(run, oracle).value(), 0.0625 / std::sqrt(2));
  EXPECT_DOUBLE_EQ(Measure(run, oracle).jitter_rest_mps.value(), 0.0625 / std::sqrt(2));
  Recording jump = MakeRecording(1, 300, Stopping(100));
  for (auto& [tick, view] : jump.views[0]) {
    if (tick >= 200) view.x[1] += 0.125f;  // once: 8 m/s among 168 ticks of two
  }
  EXPECT_DOUBLE_EQ(RestJitter(jump, oracle).value(), 8 / std::sqrt(2.0 * 168));
}

TEST(RestJitter, IsUnknownWhenTheOracleNeverRests) {
  const Path moving = Moving(1);
  EXPECT_FALSE(RestJitter(MakeRecording(1, 300, moving), MakeOracle(300, moving)).has_value());
}

// ---- the two sides of a hand-over

/// Peer 1 hands body 3 to peer 2 at tick `at`, after `gap` ticks in which nobody has it.
Recording HandedOver(std::int64_t at, std::int64_t gap) {
  Recording run = MakeRecording(3, 200, Moving(2));
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      const int holder = tick < at - gap ? 1 : tick < at ? -1 : 2;
      view.authority[0] = static_cast<std::int8_t>(std::max(holder, 0));
      view.role[0] = peer == holder ? kRoleAuthority : kRoleSecondary;
    }
  }
  return run;
}

TEST(Handover, ComparesTheOldAndTheNewAuthorityAtTheHandOver) {
  for (const std::int64_t gap : {0, 5}) {
    Recording run = HandedOver(100, gap);
    Measures right;
    MeasureHandover(run, {{3, 0}}, &right);
    EXPECT_EQ(right.handover_gap_m.value(), 0);
    EXPECT_EQ(right.handover_dv_mps.value(), 0);
    run.views[2][100].x[0] += 0.375f;
    run.views[2][100].y[0] -= 0.5f;
    run.views[2][100].vy[0] += 0.25f;
    run.views[2][101].vx[0] += 9;  // not at the hand-over
    run.views[0][100].vx[0] += 9;  // whose idea nobody asked for
    Measures m;
    MeasureHandover(run, {{3, 0}}, &m);
    EXPECT_DOUBLE_EQ(m.handover_gap_m.value(), 0.625);
    EXPECT_DOUBLE_EQ(m.handover_dv_mps.value(), 0.25);
  }
}

TEST(Handover, WithoutAChangeOfAuthorityHasNoGap) {
  Measures m;
  MeasureHandover(MakeRecording(2, 100, Moving(2)), {}, &m);
  EXPECT_EQ(m.handovers, 0);
  EXPECT_FALSE(m.handover_gap_m || m.handover_dv_mps);
}

// ---- floor and cost

TEST(Floor, EqualsTheNudgeOfOneBodyAmongFreelyFallingOnes) {
  Recording run;
  run.room.tick_hz = kHz;
  run.room.scene_name = "fall";
  run.last_tick = 64;
  run.room.scene_text =
      "[[part]]\nname = \"ball\"\ncircle = 0.5\n"
      "repeat = {count = 4, step = [0, 3]}\n";
  const Oracle oracle = ComputeOracle(run);
  EXPECT_DOUBLE_EQ(ErrorFloor(run, oracle, 0x1p-20f), 0x1p-20 / 2);  // one of four
  EXPECT_DOUBLE_EQ(ErrorFloor(run, oracle, kWireNudge), 0x1p-10 / 2);
  EXPECT_NEAR(ErrorFloor(run, oracle), 1e-6 / 2, 1e-12);
  // A ball balanced on a point falls to either side: a micrometre becomes metres.
  run.room.scene_text =
      "[solver]\nsleep = false\n[[part]]\nname = \"ball\"\ncircle = 0.5\n"
      "[[part]]\nname = \"ridge\"\n"
      "polygon = [[-9, -9], [0, -0.51], [9, -9]]\nanchored = true\n";
  run.last_tick = 10 * kHz;
  EXPECT_GT(ErrorFloor(run, ComputeOracle(run)), 1);
}

TEST(Cost, ReportsTheBytesThatClientsSendSeparately) {
  Recording run = MakeRecording(3, 10, Moving(2));
  for (int peer = 0; peer < 3; ++peer) {
    Stats begin, end;
    begin.peer = end.peer = peer;
    end.tick = 4 * kHz;
    end.bytes_out = peer == 0 ? 1 << 20 : 1000 * peer;
    end.bytes_in = 7000;
    run.stats[peer] = {begin, end};
  }
  const Measures m = Measure(run, MakeOracle(10, Moving(2)));
  EXPECT_DOUBLE_EQ(m.sent_bytes_per_s, (250.0 + 500.0) / 2);
  EXPECT_DOUBLE_EQ(m.bytes_per_s, (2000.0 + 2250.0) / 2);
}

}  // namespace measure_displayed_test
}  // namespace seam
