/// Measures of recordings made by hand, whose answers are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/base/check.h"
#include "common/measure/parts.h"
#include "common/measure/table.h"

namespace seam {
namespace {

constexpr int kHz = 64;                 // ticks are exact in binary
constexpr double kH = 1.0 / kHz;

/// A body as a function of the tick.
using Path = std::function<BodyState(std::int64_t)>;

BodyState State(double x, double y, double vx = 0, double vy = 0, double angle = 0) {
  BodyState state;
  state.position = Vec2(static_cast<float>(x), static_cast<float>(y));
  state.velocity = Vec2(static_cast<float>(vx), static_cast<float>(vy));
  state.angle = static_cast<float>(angle);
  return state;
}

/// Moves along x at `speed`.
Path Moving(double speed) {
  return [speed](std::int64_t tick) {
    return State(speed * kH * static_cast<double>(tick), 1, speed, 0);
  };
}

/// A view of bodies 3 and 7, of which 7 stands still; peer 0 has authority unless told otherwise.
View MakeView(int peer, std::int64_t tick, const BodyState& body) {
  View view;
  view.peer = peer;
  view.tick = tick;
  for (const auto& [id, state] : {std::pair{3, body}, std::pair{7, State(-5, 0)}}) {
    view.id.push_back(static_cast<std::int16_t>(id));
    view.role.push_back(peer == 0 ? kRoleAuthority : kRoleSecondary);
    view.authority.push_back(0);
    view.x.push_back(state.position.x());
    view.y.push_back(state.position.y());
    view.angle.push_back(state.angle);
    view.vx.push_back(state.velocity.x());
    view.vy.push_back(state.velocity.y());
    view.spin.push_back(state.spin);
  }
  return view;
}

Recording MakeRecording(int peers, std::int64_t last_tick, const Path& motion) {
  Recording recording;
  recording.room.tick_hz = kHz;
  recording.room.mode = "oracle";
  for (int peer = 0; peer < peers; ++peer) {
    for (std::int64_t tick = 0; tick <= last_tick; ++tick) {
      recording.views[peer][tick] = MakeView(peer, tick, motion(tick));
    }
  }
  recording.first_tick = 0;
  recording.last_tick = last_tick;
  return recording;
}

Oracle MakeOracle(std::int64_t last_tick, const Path& motion) {
  return OracleFromRecording(MakeRecording(1, last_tick, motion));
}

TEST(Measure, ARecordingEqualToItsOracleHasNoErrorAtAll) {
  const Path motion = [](std::int64_t t) {
    const double s = static_cast<double>(t) * kH;
    return State(3 * s, std::sin(5 * s), 3, 5 * std::cos(5 * s), 2 * s);
  };
  const Measures m = Measure(MakeRecording(3, 200, motion), MakeOracle(200, motion));
  EXPECT_EQ(m.compared, 3 * 201 * 2);
  EXPECT_EQ(m.error_rms_m, 0);
  EXPECT_EQ(m.error_p95_m, 0);
  EXPECT_EQ(m.error_max_m, 0);
  EXPECT_EQ(m.error_rms_rad, 0);
  EXPECT_EQ(m.stutter_mps2, 0);
  EXPECT_EQ(m.backsteps, 0);
  EXPECT_EQ(m.handovers, 0);
  EXPECT_EQ(m.error_by_tick_m, std::vector<double>(201, 0.0));
  EXPECT_EQ(m.error_rms_by_peer_m, (std::map<int, double>{{0, 0.0}, {1, 0.0}, {2, 0.0}}));
}

TEST(Measure, AConstantOffsetIsAnErrorButNoStutter) {
  Recording run = MakeRecording(2, 100, Moving(2));
  for (auto& [tick, view] : run.views[1]) {
    view.x[0] += 0.375f;
    view.y[0] += 0.5f;
  }
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  // One body of two, on one peer of two, is 0.625 m off.
  EXPECT_DOUBLE_EQ(m.error_rms_m, 0.625 / 2);
  EXPECT_DOUBLE_EQ(m.error_max_m, 0.625);
  EXPECT_DOUBLE_EQ(m.error_p95_m, 0.625);
  EXPECT_DOUBLE_EQ(m.error_rms_by_peer_m.at(0), 0);
  EXPECT_DOUBLE_EQ(m.error_rms_by_peer_m.at(1), 0.625 / std::sqrt(2));
  EXPECT_DOUBLE_EQ(m.error_by_tick_m.at(50), 0.625 / 2);
  EXPECT_EQ(m.stutter_mps2, 0);
}

TEST(Measure, OneJumpHasExactlyTheStutterAndTheErrorOfItsSize) {
  Recording run = MakeRecording(1, 100, Moving(2));
  for (auto& [tick, view] : run.views[0]) {
    if (tick >= 60) view.x[0] += 0.125f;
  }
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_DOUBLE_EQ(m.error_max_m, 0.125);
  EXPECT_DOUBLE_EQ(m.error_rms_m, 0.125 * std::sqrt(41.0 / 202));
  // A step shows in two second differences, +a and -a, among 99 for each of two bodies.
  EXPECT_DOUBLE_EQ(m.stutter_mps2, 0.125 / (kH * kH) * std::sqrt(2.0 / 198));
  EXPECT_EQ(m.backsteps, 0);
  EXPECT_EQ(m.error_by_tick_m.at(59), 0);
  EXPECT_DOUBLE_EQ(m.error_by_tick_m.at(60), 0.125 / std::sqrt(2));
}

TEST(Measure, StutterNeedsThreeViewsInARow) {
  Recording run = MakeRecording(1, 100, Moving(2));
  for (auto& [tick, view] : run.views[0]) {
    if (tick >= 60) view.x[0] += 0.125f;
  }
  run.views[0].erase(60);               // the jump is between views that do not follow each other
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_EQ(m.stutter_mps2, 0);
  EXPECT_DOUBLE_EQ(m.error_max_m, 0.125);
}

TEST(Measure, TheOraclesOwnAccelerationIsNoStutter) {
  const Path bouncing = [](std::int64_t tick) {
    const double u = static_cast<double>(tick % 20) - 10;
    return State(0, u * u / 64, 0, u > 0 ? 1 : -1);
  };
  EXPECT_EQ(Measure(MakeRecording(2, 200, bouncing), MakeOracle(200, bouncing)).stutter_mps2, 0);
}

TEST(Measure, CountsExactlyTheStepsAgainstTheVelocity) {
  Recording run = MakeRecording(2, 100, Moving(2));   // 1/32 m a tick
  for (const std::int64_t tick : {20, 40, 60}) run.views[1][tick].x[0] -= 0.0625f;
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_EQ(m.backsteps, 3);
}

TEST(Measure, StepsOfLessThanAMillimetreOrOfSlowBodiesAreNoBacksteps) {
  Recording run = MakeRecording(1, 100, Moving(2));
  run.views[0][20].x[0] = run.views[0][19].x[0] - 0.0009765625f;
  EXPECT_EQ(Measure(run, MakeOracle(100, Moving(2))).backsteps, 0);
  run.views[0][20].x[0] = run.views[0][19].x[0] - 0.001953125f;
  EXPECT_EQ(Measure(run, MakeOracle(100, Moving(2))).backsteps, 1);
  run = MakeRecording(1, 100, Moving(0.5));
  run.views[0][20].x[0] -= 1;
  EXPECT_EQ(Measure(run, MakeOracle(100, Moving(0.5))).backsteps, 0);
}

TEST(Measure, ABackstepOfTheOracleItselfIsForgiven) {
  const Path wheel = [](std::int64_t tick) {   // its root goes back while its mass goes on
    return State(tick % 10 == 5 ? -1 : 0, 0, 2, 0);
  };
  EXPECT_EQ(Measure(MakeRecording(1, 50, wheel), MakeOracle(50, wheel)).backsteps, 0);
  EXPECT_EQ(Measure(MakeRecording(1, 50, wheel), MakeOracle(50, Moving(2))).backsteps, 5);
}

TEST(Measure, TheNinetyFifthPercentileIsTheNearestRank) {
  const auto off = [](std::int64_t tick) { return State(static_cast<double>(tick), 0); };
  Recording run = MakeRecording(1, 100, off);
  run.views[0].erase(0);
  for (auto& [tick, view] : run.views[0]) {   // only body 3: errors 1, 2, ... 100 m
    view.id = {3};
    view.x.resize(1);
  }
  const Measures m = Measure(run, MakeOracle(100, [](std::int64_t) { return State(0, 0); }));
  EXPECT_EQ(m.compared, 100);
  EXPECT_DOUBLE_EQ(m.error_p95_m, 95);
  EXPECT_DOUBLE_EQ(m.error_max_m, 100);
  EXPECT_DOUBLE_EQ(m.error_rms_m, std::sqrt(338350.0 / 100));
}

TEST(Measure, AnglesAreComparedTheShortWayRound) {
  const Path turned = [](std::int64_t) { return State(0, 0, 0, 0, 3.125); };
  const Path truth = [](std::int64_t) { return State(0, 0, 0, 0, -3.125); };
  const Measures m = Measure(MakeRecording(1, 10, turned), MakeOracle(10, truth));
  EXPECT_NEAR(m.error_rms_rad, (2 * M_PI - 6.25) / std::sqrt(2), 1e-12);
  const Path twice = [](std::int64_t) { return State(0, 0, 0, 0, 4 * M_PI - 3.125); };
  EXPECT_NEAR(Measure(MakeRecording(1, 10, twice), MakeOracle(10, truth)).error_rms_rad, 0, 1e-6);
}

TEST(Measure, TicksAndBodiesTheOracleDoesNotHaveAreLeftOut) {
  Recording run = MakeRecording(1, 100, Moving(2));
  for (auto& [tick, view] : run.views[0]) view.id[1] = 9;
  Oracle oracle = MakeOracle(50, Moving(2));
  EXPECT_EQ(Measure(run, oracle).compared, 51);
  oracle.first_tick = 1000;
  const Measures m = Measure(run, oracle);
  EXPECT_EQ(m.compared, 0);
  EXPECT_EQ(CsvLine({"r", run.room, m, 0, 0}), ",r,oracle,,,0,,,,,,,,");
}

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

TEST(Rebound, ALateBlowIsStillTheWholeBlow) {
  const Oracle oracle = MakeOracle(200, Struck(4));
  const auto rebound = Rebound(MakeRecording(1, 200, Struck(4, 13)), oracle, {{3, 1}}, 10);
  EXPECT_DOUBLE_EQ(rebound.value(), 1);
}

TEST(Rebound, IsReadFromThePeerWithAuthority) {
  Recording run = MakeRecording(2, 200, Struck(4));
  for (auto& [tick, view] : run.views[0]) {   // the server is a secondary with wrong ideas
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

TEST(Rebound, BlowsBeforeTheWatchedTickAreNotMeant) {
  const Path twice = [](std::int64_t tick) {
    return State(0, 0, tick < 20 ? 0 : tick < 100 ? 50 : 54, 0);
  };
  const Path half = [](std::int64_t tick) {
    return State(0, 0, tick < 20 ? 0 : tick < 100 ? 50 : 52, 0);
  };
  const Oracle oracle = MakeOracle(200, twice);
  EXPECT_DOUBLE_EQ(Rebound(MakeRecording(1, 200, half), oracle, {{3, 1}}, 60).value(), 0.5);
}

TEST(Rebound, WithoutACollisionOrItsEndThereIsNone) {
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
    x = std::nextafter(x, 0.0f);        // one bit, on one peer
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

TEST(Rest, IsUnknownWhenTheOracleNeverRestsOrNobodyElseLooks) {
  EXPECT_FALSE(RestTicks(MakeRecording(2, 300, Moving(1)), MakeOracle(300, Moving(1))).has_value());
  const Oracle oracle = MakeOracle(300, Stopping(100));
  EXPECT_FALSE(RestTicks(MakeRecording(1, 300, Stopping(100)), oracle).has_value());
  EXPECT_FALSE(RestTicks(MakeRecording(2, 300, Stopping(290)), MakeOracle(300, Stopping(290)))
                   .has_value());       // too short to be for good
}

// ---- hand-over

TEST(Handover, MeasuresTheJumpBeyondTheMotionAndCountsMechanismsOnce) {
  Recording run = MakeRecording(2, 100, Moving(2));
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      if (tick >= 50) view.authority[0] = view.authority[1] = 1;   // both bodies at tick 50
      if (tick >= 70) view.authority[0] = 0;
    }
  }
  for (auto& [tick, view] : run.views[1]) {
    if (tick >= 50) view.y[0] += 0.25f;
    if (tick >= 80) view.y[0] += 4;      // a jump, but not at a hand-over
  }
  Measures m;
  MeasureHandover(run, {{3, 0}, {7, 0}}, &m);
  EXPECT_EQ(m.handovers, 2);
  EXPECT_DOUBLE_EQ(m.handover_jump_m, 0.25);
  Measures apart;
  MeasureHandover(run, {{3, 0}, {7, 1}}, &apart);
  EXPECT_EQ(apart.handovers, 3);
  EXPECT_EQ(Measure(run, MakeOracle(100, Moving(2))).handovers, 3);   // no scene: every body one
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
  run.stats[1] = {MakeStats(1, 0, 0, 0, 0), MakeStats(1, 0, 90'000, 0, 0),   // waits for players
                  MakeStats(1, kHz, 91'000, 0, 0), MakeStats(1, 2 * kHz, 10, 0, 0),
                  MakeStats(1, 3 * kHz, 1010, 0, 0)};
  EXPECT_DOUBLE_EQ(Measure(run, MakeOracle(10, Moving(2))).bytes_per_s, 1000);
}

// ---- oracles and tables

TEST(Oracle, OfARecordingNeedsModeOracleAndTheServersViews) {
  Recording run = MakeRecording(2, 10, Moving(2));
  run.room.mode = "buffer";
  EXPECT_THROW((void)OracleFromRecording(run), OperatorError);
  run.room.mode = "oracle";
  EXPECT_EQ(OracleFromRecording(run).ids, (std::vector<PartId>{3, 7}));
  run.views[0].erase(5);
  const Oracle oracle = OracleFromRecording(run);
  EXPECT_EQ(oracle.At(5, 3), nullptr);
  EXPECT_EQ(oracle.At(11, 3), nullptr);
  EXPECT_EQ(oracle.At(-1, 3), nullptr);
  EXPECT_EQ(oracle.At(6, 4), nullptr);
  ASSERT_NE(oracle.At(6, 7), nullptr);
  EXPECT_EQ(oracle.At(6, 7)->position.x(), -5);
  run.views.erase(0);
  EXPECT_THROW((void)OracleFromRecording(run), OperatorError);
}

TEST(Table, HasExactlyTheAgreedColumns) {
  EXPECT_EQ(CsvHeader(),
            "scene,run,mode,reconcile,impair,seed,error_rms_m,error_p95_m,error_max_m,stutter_mps2,"
            "backsteps,rebound,bytes_per_s,cpu_us_per_s");
  MeasuredRun run;
  run.run = "a \"b\"";
  run.room.scene_name = "crossing";
  run.room.mode = "buffer";
  run.room.reconcile = "retrospect";
  run.room.impair = "delay=50ms,loss=1%";
  run.room.seed = -3;
  run.measures.compared = 1;
  run.measures.error_rms_m = 0.0123456789;
  run.measures.error_p95_m = 0.5;
  run.measures.error_max_m = 2;
  run.measures.stutter_mps2 = 1234567;
  run.measures.backsteps = 12;
  run.measures.rebound = 0.5;
  run.measures.bytes_per_s = 4096;
  EXPECT_EQ(CsvLine(run),
            "crossing,\"a \"\"b\"\"\",buffer,retrospect,\"delay=50ms,loss=1%\",-3,0.0123457,0.5,2,"
            "1.23457e+06,12,0.5,4096,");
}

TEST(Table, IsAlignedAndShowsWhatDoesNotApplyAsADash) {
  MeasuredRun first, second;
  first.run = "a";
  second.run = "much_longer";
  const std::string text = FormatTable({first, second}, false);
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    lines.push_back(text.substr(at, text.find('\n', at) - at));
  }
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].size(), lines[1].size());
  EXPECT_EQ(lines[0].size(), lines[2].size());
  EXPECT_EQ(lines[2].find("much_longer"), lines[0].find("run"));
  EXPECT_EQ(lines[1].back(), '-');
  EXPECT_NE(FormatTable({first}, true).find("hand-over"), std::string::npos);
}

}  // namespace
}  // namespace seam
