/// seam-lab sweep: its table is the same for any number of jobs and interruptions, and its rows
/// equal the measures of the other programs.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <sstream>

#include "common/base/check.h"
#include "common/measure/measure.h"
#include "tests/lab/grid.h"
#include "tests/lab/sweep_row.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_sweep_test {

Grid GridOf(const LabWorkspace& files, const std::string& text) {
  files.Write("sweep.toml", text);
  return ReadGrid(files / "sweep.toml");
}

/// The table without its last columns, CPU times.
std::string WithoutCpu(const std::string& table) {
  std::istringstream in(table);
  std::string out;
  for (std::string line; std::getline(in, line);) {
    for (int column = 0; column < 3; ++column) line.resize(line.rfind(','));
    out += line + "\n";
  }
  return out;
}

const char* const kTiny = R"(
scenes = ["scenes/crossing.toml", "scenes/cradle.toml"]
methods = ["strict", "buffer/fade"]
impair = ["delay=50ms,loss=1%"]
seeds = [1, 2]
duration = 1
)";

std::vector<std::string> SweepWords(const LabWorkspace& files, const char* table,
                                    const char* jobs) {
  return {LabProgram(), "sweep", files / "sweep.toml", "-o", files / table, "--jobs", jobs};
}

void RunWhole(const std::vector<std::string>& words, const std::string& said) {
  ChildProcess lab(words);
  ASSERT_TRUE(lab.Wait(120));
  EXPECT_EQ(lab.exit_status(), 0) << lab.output();
  EXPECT_NE(lab.output().find(said), std::string::npos) << lab.output();
}

TEST(LabSweep, TheTableIsTheSameForAnyJobsAndAfterAnyInterruption) {
  const LabWorkspace files;
  files.Write("sweep.toml", kTiny);
  RunWhole(SweepWords(files, "one.csv", "1"), "8 of 8 rows, 8 of them new");
  RunWhole(SweepWords(files, "two.csv", "2"), "8 of 8 rows, 8 of them new");
  const std::string whole = files.Read("one.csv");
  EXPECT_EQ(whole.rfind(SweepKeyColumns() + "," + SweepValueColumns() + "\n" + kLabVersion, 0), 0u);
  EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 9);
  EXPECT_EQ(WithoutCpu(files.Read("two.csv")), WithoutCpu(whole));
  // Cut in the middle of a row: the existing bytes stay as they were.
  std::size_t rows = 0;  // the header and four rows
  for (int line = 0; line < 5; ++line) rows = whole.find('\n', rows) + 1;
  const std::size_t cut = rows + 100;
  files.Write("two.csv", whole.substr(0, cut));
  RunWhole(SweepWords(files, "two.csv", "2"), "8 of 8 rows, 4 of them new");
  const std::string resumed = files.Read("two.csv");
  EXPECT_EQ(WithoutCpu(resumed), WithoutCpu(whole));
  EXPECT_EQ(resumed.substr(0, rows), whole.substr(0, rows));
  RunWhole(SweepWords(files, "two.csv", "2"), "8 of 8 rows, 0 of them new");
  EXPECT_EQ(files.Read("two.csv"), resumed);
  // A longer list of seeds keeps the rows there are.
  std::string more = kTiny;
  more.replace(more.find("[1, 2]"), 6, "[3, 1, 2]");
  files.Write("sweep.toml", more);
  RunWhole(SweepWords(files, "two.csv", "2"), "12 of 12 rows, 4 of them new");
  RunWhole(SweepWords(files, "new.csv", "2"), "12 of 12 rows, 12 of them new");
  EXPECT_EQ(WithoutCpu(files.Read("two.csv")), WithoutCpu(files.Read("new.csv")));
}

TEST(LabSweep, AKilledOrStoppedSweepResumes) {
  const LabWorkspace files;
  files.Write("sweep.toml", "scenes = \"scenes/cradle.toml\"\nseeds = {count = 12}\nfloor = false");
  RunWhole(SweepWords(files, "whole.csv", "2"), "12 of 12 rows");
  for (const int signal : {SIGKILL, SIGINT}) {
    ChildProcess lab(SweepWords(files, "t.csv", "2"));
    for (int i = 0; i < 3000; ++i) {  // until some rows are there
      const std::string text = files.Read("t.csv");
      if (std::count(text.begin(), text.end(), '\n') >= 3) break;
      usleep(2000);
    }
    lab.Stop(signal);
    RunWhole(SweepWords(files, "t.csv", "2"), "12 of 12 rows");
    EXPECT_EQ(WithoutCpu(files.Read("t.csv")), WithoutCpu(files.Read("whole.csv")));
    EXPECT_EQ(unlink((files / "t.csv").c_str()), 0);
  }
}

/// The text of a column.
std::string ColumnOf(const Values& values, const std::string& column) {
  for (const Value& value : values) {
    if (value.column == column) return value.text;
  }
  ADD_FAILURE() << "no column " << column;
  return "";
}

TEST(LabSweep, ARowHoldsTheMeasuresOfItsRun) {
  const LabWorkspace files;
  const Grid grid = GridOf(files, "scenes = \"scenes/crossing.toml\"\nmethods = \"buffer/fade\"");
  const Values row = SweepValues(grid.points[0], {true, false});
  const Recording recording = RunCluster(Configure(grid.points[0].settings));
  const Oracle oracle = ComputeOracle(recording);
  const Measures m = Measure(recording, oracle);
  ASSERT_TRUE(m.rebound.has_value());
  const auto value = [&](const std::string& column) { return ColumnOf(row, column); };
  const auto number = [](double x) { return fmt::format("{:.6g}", x); };
  EXPECT_EQ(CsvRow(row).rfind(CsvRow(PointValues(grid.points[0])) + ",", 0), 0u);
  EXPECT_EQ(value("error_rms_m"), number(m.error_rms_m));
  EXPECT_EQ(value("error_p95_m"), number(m.error_p95_m));
  EXPECT_EQ(value("error_max_m"), number(m.error_max_m));
  EXPECT_EQ(value("error_rms_rad"), number(m.error_rms_rad));
  EXPECT_EQ(value("stutter_mps2"), number(m.stutter_mps2));
  EXPECT_EQ(value("backsteps"), std::to_string(m.backsteps));
  EXPECT_EQ(value("seam_rms_m"), number(m.seam_rms_m.value()));
  EXPECT_EQ(value("seam_stutter_mps2"), number(m.seam_stutter_mps2.value()));
  EXPECT_EQ(value("rebound"), number(*m.rebound));
  EXPECT_EQ(value("rest_ticks"), "");
  EXPECT_EQ(value("jitter_rest_mps"), "");
  EXPECT_EQ(value("penetration_m"), number(m.penetration_m.value()));
  EXPECT_EQ(value("oracle_penetration_m"), number(m.oracle_penetration_m.value()));
  EXPECT_EQ(value("joint_drift_m"), number(m.joint_drift_m.value()));
  EXPECT_EQ(value("oracle_joint_drift_m"), number(m.oracle_joint_drift_m.value()));
  EXPECT_EQ(value("energy_gain_j"), number(m.energy_gain_j.value()));
  EXPECT_EQ(value("handovers"), "0");
  EXPECT_EQ(value("handover_jump_m"), "") << "there was none";
  EXPECT_EQ(value("handover_gap_m"), "");
  EXPECT_EQ(value("handover_dv_mps"), "");
  EXPECT_EQ(value("floor_m"), number(ErrorFloor(recording, oracle)));
  EXPECT_EQ(value("floor_wire_m"), number(ErrorFloor(recording, oracle, kWireNudge)));
  EXPECT_EQ(value("bytes_per_s"), number(m.bytes_per_s));
  EXPECT_EQ(value("sent_bytes_per_s"), number(m.sent_bytes_per_s));
  EXPECT_EQ(value("compared"), std::to_string(m.compared));
  EXPECT_EQ(CsvColumns(row), SweepValueColumns());
}

TEST(LabSweep, RunRepeatsARowWithTheSceneSetInItsText) {
  const LabWorkspace files;
  const Grid grid = GridOf(files,
                           "scenes = \"scenes/crossing.toml\"\nsubsteps = [3]\n"
                           "buffer_m = [7]\nduration = 3\nimpair = \"4g\"");
  const Recording swept = RunCluster(Configure(grid.points[0].settings, *grid.points[0].scene));
  ChildProcess lab({LabProgram(), "run", "scenes/crossing.toml", "--duration", "3", "--impair",
                    "4g", "--set", "solver.substeps=3", "--buffer", "7", "-o", files / "a.lcm"});
  ASSERT_TRUE(lab.Wait(60));
  ASSERT_EQ(lab.exit_status(), 0) << lab.output();
  EXPECT_NE(lab.output().find("floor "), std::string::npos) << lab.output();
  const Recording run = ReadRecording(files / "a.lcm");
  EXPECT_EQ(run.room.scene_text, grid.points[0].scene->text);
  const Scene scene = ParseScene(run.room.scene_text, "a.toml");
  EXPECT_EQ(scene.solver.substeps, 3);
  EXPECT_EQ(scene.buffer_m, 7);
  EXPECT_EQ(Measure(run, ComputeOracle(run)).error_rms_m,
            Measure(swept, ComputeOracle(swept)).error_rms_m);
  // And it matters: peers and oracle really take three substeps.
  SessionSettings plain = grid.points[0].settings;
  plain.set = {"buffer=7"};
  const Recording other = RunCluster(Configure(plain));
  EXPECT_NE(ComputeOracle(other).At(170, 2)->position, ComputeOracle(run).At(170, 2)->position);
}

TEST(LabSweep, ARunThatFailsLeavesNoRowAndTheOthersGoOn) {
  const LabWorkspace files;
  files.Write("sweep.toml",
              "scenes = \"scenes/crossing.toml\"\nduration = 1\n"
              "impair = [\"loss=100%\", \"perfect\"]");
  ChildProcess lab(SweepWords(files, "t.csv", "1"));
  ASSERT_TRUE(lab.Wait(60));
  EXPECT_EQ(lab.exit_status(), 1);
  EXPECT_NE(lab.output().find("1 of 2 rows, 1 of them new; 1 runs failed"), std::string::npos)
      << lab.output();
  EXPECT_NE(lab.output().find("no tick within 30 s"), std::string::npos) << lab.output();
  files.Write("other.csv", "mine\n");
  ChildProcess refused(SweepWords(files, "other.csv", "1"));
  ASSERT_TRUE(refused.Wait(60));
  EXPECT_EQ(refused.exit_status(), 2) << refused.output();
  EXPECT_EQ(files.Read("other.csv"), "mine\n");
}

}  // namespace lab_sweep_test
}  // namespace seam
