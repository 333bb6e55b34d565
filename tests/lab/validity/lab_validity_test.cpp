/// Rows of runs that miss their scene's expected event: how a run is judged, and how the report
/// shows it.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/lab/commands.h"
#include "tests/lab/report/sweep_section.h"
#include "tests/lab/report/validity.h"
#include "tests/lab/sweep_row.h"
#include "tests/lab/validity/loss.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_validity_test {

/// A scene in which nothing touches anything, with what it expects.
std::string Apart(const std::string& expect) {
  return "duration = 1\nexpect = [" + expect + "]\n" + R"(
[[player]]
name = "ann"
region = [[-100, -100], [-0.1, 100]]
[[player]]
name = "bob"
region = [[0, -100], [100, 100]]
[[part]]
name = "floor"
chain = [[-50, 0], [50, 0]]
[[part]]
name = "a"
box = [1, 1]
position = [-5, 0.5]
[[part]]
name = "b"
box = [1, 1]
position = [5, 0.5]
)";
}

/// The one row of a sweep over that scene, by column.
std::map<std::string, std::string> RowOf(const std::string& expect, const std::string& more) {
  const LabWorkspace files;
  files.Write("apart.toml", Apart(expect));
  files.Write("sweep.toml", "scenes = '" + (files / "apart.toml") + "'\n" + more);
  const Grid grid = ReadGrid(files / "sweep.toml");
  std::map<std::string, std::string> row;
  for (const Value& value : SweepValues(grid.points[0], {false, false})) {
    row[value.column] = value.text;
  }
  return row;
}

TEST(Validity, ARowThatMissesAnExpectedEventHasAReasonAndNoFigures) {
  const std::map<std::string, std::string> reasons = {
      {"'contact'", "no contact between two players' bodies"},
      {"'hand-over'", "no hand-over"},
      {"'edit'", "no edit"}};
  for (const auto& [expect, reason] : reasons) {
    auto row = RowOf(expect, "");
    EXPECT_EQ(row["valid"], reason);
    EXPECT_EQ(row["error_rms_m"], "") << expect;
    EXPECT_EQ(row["compared"], "") << expect;
    EXPECT_NE(row["digest"], "") << expect;
  }
  auto row = RowOf("", "");
  EXPECT_EQ(row["valid"], "");
  EXPECT_NE(row["error_rms_m"], "");
}

TEST(Validity, AHandOverIsExpectedOnlyOfModesThatHaveThem) {
  EXPECT_EQ(RowOf("'hand-over'", "methods = 'central'")["valid"], "");
  EXPECT_EQ(RowOf("'hand-over'", "methods = 'strict'")["valid"], "no hand-over");
}

TEST(Validity, ARowNamesItsOracle) {
  EXPECT_EQ(RowOf("", "methods = 'buffer/rollback'")["oracle"], "barrier");
  EXPECT_EQ(RowOf("", "methods = 'buffer/fade'")["oracle"], "plain");
  EXPECT_EQ(RowOf("", "methods = 'central/all'")["oracle"], "barrier");
  EXPECT_EQ(RowOf("", "methods = 'central/own'")["oracle"], "plain");
}

TEST(Validity, TheLossMayBeSmallerOnlyByChance) {
  const ImpairProfile even = FindProfile("loss=10%");
  EXPECT_DOUBLE_EQ(MeanLoss(even), 0.1);
  EXPECT_NEAR(LossDeviation(even, 10000), 30, 1e-9);
  EXPECT_FALSE(LossTooSmall(even, {10000, 900}));
  EXPECT_FALSE(LossTooSmall(even, {10000, 811}));
  EXPECT_TRUE(LossTooSmall(even, {10000, 809}));
  EXPECT_FALSE(LossTooSmall(even, {20, 0})) << "too few to say";
  EXPECT_FALSE(LossTooSmall(FindProfile("perfect"), {10000, 0}));
  // In bursts of ten the same share is less certain: about 4.4 times the deviation.
  const ImpairProfile bursts = FindProfile("burst=1.111%:10%");
  EXPECT_NEAR(MeanLoss(bursts), 0.1, 1e-4);
  EXPECT_GT(LossDeviation(bursts, 10000), 4 * 30);
  EXPECT_FALSE(LossTooSmall(bursts, {10000, 809}));
  EXPECT_TRUE(LossTooSmall(bursts, {10000, 300}));
}

TEST(Validity, AnImpairedNetworkCountsItsLosses) {
  ClusterConfig config;
  config.scene = "crossing";
  config.impair = "loss=20%";
  config.duration_s = 3;
  Cluster cluster(config);
  cluster.Run();
  const ImpairedTraffic traffic = cluster.server_net().traffic();
  ASSERT_GT(traffic.offered, 300);
  const double share = static_cast<double>(traffic.lost) / static_cast<double>(traffic.offered);
  EXPECT_NEAR(share, 0.2, 0.06);
  EXPECT_FALSE(LossTooSmall(FindProfile("loss=20%"), traffic));
  EXPECT_TRUE(LossTooSmall(FindProfile("loss=60%"), traffic));
}

/// `invalid` of twenty runs of one method have no figures.
std::string TableWith(int invalid) {
  std::string text = "version,scene,mode,reconcile,impair,drive,seed,error_rms_m,valid,cpu_s\n";
  for (int seed = 1; seed <= 20; ++seed) {
    const std::string end = seed <= invalid ? ",,no contact,0.1\n" : ",0.25,,0.1\n";
    text += "v,wall.toml,buffer,fade,delay=20ms,script," + std::to_string(seed) + end;
  }
  return text;
}

std::string ErrorCell(int invalid) {
  const char* const other = "v,wall.toml,buffer,fade,delay=40ms,script,1,0.5,,0.1\n";
  CsvTable table = CsvTable::Parse(TableWith(invalid) + other, "t.csv");
  SweepView view = ViewSweep(table);
  const Section section = SweepSection({"t", "", std::move(table), std::move(view)});
  for (const PageItem& item : section.items) {
    const auto* text = std::get_if<TextTable>(&item);
    if (text != nullptr && text->name == "t-wall-error") return text->rows.at(0).at(1);
  }
  return "no such table";
}

TEST(Validity, TablesPrintTheReasonOrHowManyAreLeftOut) {
  EXPECT_EQ(ErrorCell(0).find("valid"), std::string::npos);
  EXPECT_EQ(ErrorCell(0).rfind("0.25", 0), 0u) << ErrorCell(0);
  EXPECT_EQ(ErrorCell(2), ErrorCell(0) + " (2 of 20 not valid)");
  EXPECT_EQ(ErrorCell(20), "not valid: no contact");
}

TEST(Validity, AReportOfATableWithMoreThanATenthNotValidFailsAndNamesIt) {
  for (const int invalid : {2, 3}) {
    const LabWorkspace files;
    std::filesystem::create_directories(files / "data");
    files.Write("data/t.csv", TableWith(invalid));
    ChildProcess run({LabProgram(), "report", files / "data", "-o", files / "out"});
    ASSERT_TRUE(run.Wait(60));
    EXPECT_EQ(run.exit_status(), invalid == 3 ? 1 : 0) << run.output();
    const std::string line =
        (files / "data/t.csv") + ": 3 of 20 rows are not valid, the first: no contact\n";
    EXPECT_EQ(run.output().find(line) != std::string::npos, invalid == 3) << run.output();
    EXPECT_TRUE(std::filesystem::exists(files / "out/index.html"));
  }
}

TEST(Validity, ATableOfAnEarlierVersionHasNoSuchColumnAndIsValid) {
  const CsvTable table = CsvTable::Parse("a\n1\n2\n", "t.csv");
  EXPECT_EQ(FindValidity(table).rows, 2u);
  EXPECT_EQ(FindValidity(table).invalid, 0u);
}

}  // namespace lab_validity_test
}  // namespace seam
