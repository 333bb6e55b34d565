/// Errors, stutter, backsteps and tables, of recordings made by hand with known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/base/check.h"
#include "common/measure/table.h"
#include "tests/support/made_recording.h"

namespace seam {
namespace measure_test {

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
  EXPECT_EQ(m.shown_error_by_tick_m, std::vector<double>(201, 0.0));
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
  EXPECT_DOUBLE_EQ(m.shown_error_by_tick_m.at(50), 0.625 / 2);
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
  EXPECT_EQ(m.shown_error_by_tick_m.at(59), 0);
  EXPECT_DOUBLE_EQ(m.shown_error_by_tick_m.at(60), 0.125 / std::sqrt(2));
}

TEST(Measure, StutterNeedsThreeViewsInARow) {
  Recording run = MakeRecording(1, 100, Moving(2));
  for (auto& [tick, view] : run.views[0]) {
    if (tick >= 60) view.x[0] += 0.125f;
  }
  run.views[0].erase(60);  // the jump is between views that do not follow each other
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
  Recording run = MakeRecording(2, 100, Moving(2));  // 1/32 m a tick
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
  const Path wheel = [](std::int64_t tick) {  // its root goes back while its mass goes on
    return State(tick % 10 == 5 ? -1 : 0, 0, 2, 0);
  };
  EXPECT_EQ(Measure(MakeRecording(1, 50, wheel), MakeOracle(50, wheel)).backsteps, 0);
  EXPECT_EQ(Measure(MakeRecording(1, 50, wheel), MakeOracle(50, Moving(2))).backsteps, 5);
}

TEST(Measure, TheNinetyFifthPercentileIsTheNearestRank) {
  const auto off = [](std::int64_t tick) { return State(static_cast<double>(tick), 0); };
  Recording run = MakeRecording(1, 100, off);
  run.views[0].erase(0);
  for (auto& [tick, view] : run.views[0]) {  // only body 3: errors 1, 2, ... 100 m
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
  EXPECT_EQ(CsvLine({"r", run.room, m, "", "", 0, 0}), ",r,oracle,,,0,,,,,,,,,,,,,,,,0,,,,");
}

// ---- oracles and tables

TEST(Oracle, FromARecordingNeedsModeOracleAndTheServersViews) {
  Recording run = MakeRecording(2, 10, Moving(2));
  run.room.mode = "buffer";
  EXPECT_THROW((void)OracleFromRecording(run), OperatorError);
  run.room.mode = "oracle";
  EXPECT_EQ(OracleFromRecording(run).ids, (std::vector<PartId>{3, 7}));
  run.views[0].erase(5);
  const Oracle oracle = OracleFromRecording(run);
  EXPECT_FALSE(oracle.At(5, 3).has_value());
  EXPECT_FALSE(oracle.At(11, 3).has_value());
  EXPECT_FALSE(oracle.At(-1, 3).has_value());
  EXPECT_FALSE(oracle.At(6, 4).has_value());
  ASSERT_TRUE(oracle.At(6, 7).has_value());
  EXPECT_EQ(oracle.At(6, 7)->position.x(), -5);
  run.views.erase(0);
  EXPECT_THROW((void)OracleFromRecording(run), OperatorError);
}

TEST(Oracle, NeedsTheSameSceneAndTickRate) {
  Room truth;
  truth.mode = "oracle";
  truth.scene_name = "wall";
  truth.scene_text = "[[part]]";
  Room room = truth;
  room.mode = "buffer";
  EXPECT_TRUE(OracleMismatches(truth, "o.lcm", room, "b.lcm").empty());
  EXPECT_NO_THROW(RequireOracleOf(truth, "o.lcm", room, "b.lcm"));
  room.scene_name = "stack";
  EXPECT_TRUE(OracleMismatches(truth, "o.lcm", room, "b.lcm").empty()) << "a name is no scene";

  truth.mode = "central";
  room.scene_text += "# changed";
  room.tick_hz = 120;
  const std::vector<std::string> lines = OracleMismatches(truth, "o.lcm", room, "b.lcm");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "o.lcm: made in mode central, so it is no oracle (seam-server --mode oracle)");
  EXPECT_EQ(lines[1], "b.lcm: its scene (stack) is not the one of o.lcm (wall)");
  EXPECT_EQ(lines[2], "b.lcm: its tick rate (120) is not the one of o.lcm (60)");
  try {
    RequireOracleOf(truth, "o.lcm", room, "b.lcm");
    FAIL() << "it is no oracle";
  } catch (const OperatorError& error) {
    EXPECT_EQ(error.what(), lines[0] + "; " + lines[1] + "; " + lines[2]);
  }
}

TEST(Table, HasExactlyTheAgreedColumns) {
  EXPECT_EQ(CsvHeader(),
            "scene,run,mode,reconcile,impair,seed,error_others_m,error_own_m,path_error_rms_m,"
            "view_age_ms,response_own_ms,response_other_ms,seen,"
            "error_rms_m,error_p95_m,error_max_m,stutter_mps2,"
            "backsteps,rebound,bytes_per_s,cpu_us_per_s,inputs_late,error_served_m,"
            "overlap_p99_m,stutter_shown_mps2,valid");
  MeasuredRun run;
  run.run = "a \"b\"";
  run.room.scene_name = "crossing";
  run.room.mode = "buffer";
  run.room.reconcile = "retrospect";
  run.room.impair = "delay=50ms,loss=1%";
  run.room.seed = -3;
  run.measures.compared = 1;
  run.measures.error_others_m = 0.25;
  run.measures.view_age_ms = 150;
  run.measures.seen = 0.75;
  run.measures.error_rms_m = 0.0123456789;
  run.measures.error_p95_m = 0.5;
  run.measures.error_max_m = 2;
  run.measures.stutter_mps2 = 1234567;
  run.measures.backsteps = 12;
  run.measures.rebound = 0.5;
  run.measures.bytes_per_s = 4096;
  run.measures.inputs_late = 3;
  run.measures.error_served_m = 0.125;
  run.measures.overlap_p99_m = 0.0625;
  run.measures.stutter_shown_mps2 = 3;
  EXPECT_EQ(
      CsvLine(run),
      "crossing,\"a "
      "\"\"b\"\"\",buffer,retrospect,\"delay=50ms,loss=1%\",-3,0.25,,,150,,,0.75,0.0123457,0.5,2,"
      "1.23457e+06,12,0.5,4096,,3,0.125,0.0625,3,");
  run.valid = "no edit";
  EXPECT_EQ(CsvLine(run), "crossing,\"a \"\"b\"\"\",buffer,retrospect,\"delay=50ms,loss=1%\",-3" +
                              std::string(20, ',') + "no edit");
  EXPECT_NE(FormatTable({run}, false).find("not valid: no edit"), std::string::npos);
}

TEST(Table, IsAlignedAndMarksMissingValuesWithADash) {
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

}  // namespace measure_test
}  // namespace seam
