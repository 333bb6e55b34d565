/// seam-lab physics with scenes of the user's own: the table, the front, the plot, and the messages
/// for scenes that cannot be judged.

#include <gtest/gtest.h>

#include "tests/lab/exact/front.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/hard/observe.h"
#include "tests/lab/physics_row.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_exact_command_test {

const char* const kBall =
    "duration = 1\n[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 10]\n";
const char* const kTruth =
    "[[script]]\nname = \"truth\"\ncode = '''\nfunction exact(t) return {ball = {y = 10 - 5 * t * "
    "t}} end\n'''\n";

/// Three links that begin level: after some seconds their path is another at any step.
const char* const kChaos =
    "duration = 30\n[[part]]\nname = \"hook\"\nbox = [0.1, 0.1]\nanchored = true\ngroup = -1\n"
    "[[part]]\nname = \"upper\"\nbox = [1, 0.1]\nposition = [0.5, 0]\ngroup = -1\n"
    "[[part]]\nname = \"lower\"\nbox = [1, 0.1]\nposition = [1.5, 0]\ngroup = -1\n"
    "[[joint]]\nname = \"a\"\nkind = \"revolute\"\na = \"hook\"\nb = \"upper\"\nanchor = [0, 0]\n"
    "[[joint]]\nname = \"b\"\nkind = \"revolute\"\na = \"upper\"\nb = \"lower\"\nanchor = [1, 0]\n";

/// Runs seam-lab in the folder of `files`.
std::string RunIn(const LabWorkspace& files, const std::string& words, int status) {
  const std::string go = "cd '" + files / "" + "' && '" +
                         std::filesystem::absolute(LabProgram()).string() + "' " + words;
  ChildProcess lab({"sh", "-c", go});
  EXPECT_TRUE(lab.Wait(120));
  EXPECT_EQ(lab.exit_status(), status) << lab.output();
  return lab.output();
}

TEST(LabPhysicsOwn, JudgesAndDrawsAllSettingsByTheScenesAnswer) {
  const LabWorkspace files;
  files.Write("my.toml", std::string(kBall) + kTruth);
  const std::string said = RunIn(files, "physics my.toml --grid quick --quiet", 0);
  EXPECT_NE(said.find("my, 1 s: worst distance of any point of a part"), std::string::npos) << said;
  EXPECT_NE(said.find("my: the front, of "), std::string::npos) << said;
  const CsvTable table = CsvTable::Load(files / "out/physics/my/physics.csv");
  ASSERT_GE(table.rows(), 5u);
  EXPECT_EQ(table.Text(0, "role"), "stock");
  EXPECT_EQ(table.Text(0, "truth"), "formula");
  EXPECT_EQ(table.Text(0, "unit"), "m");
  EXPECT_NEAR(*table.Number(0, "error"), 5.0 / 60, 1e-3);
  std::size_t twice = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.Text(row, "tick_hz") != "60" || table.Text(row, "substeps") != "2") continue;
    EXPECT_NEAR(*table.Number(row, "error"), 5.0 / 120, 1e-3);
    ++twice;
  }
  EXPECT_GE(twice, 1u);
  EXPECT_GT(files.Read("out/physics/my/plots/case-my.svg").size(), 1000u);
  EXPECT_NE(files.Read("out/physics/my/tables/hard-cases.md").find("| my | formula | m |"),
            std::string::npos);
  // An edited scene: the table at the usual place is begun anew, one that was asked for is not.
  RunIn(files, "physics my.toml --grid quick --quiet -o mine.csv", 0);
  files.Write("my.toml", "gravity = [0, -5]\n" + std::string(kBall) + kTruth);
  RunIn(files, "physics my.toml --grid quick --quiet", 0);
  EXPECT_NEAR(*CsvTable::Load(files / "out/physics/my/physics.csv").Number(0, "error"), 2.5, 0.1);
  RunIn(files, "physics my.toml --grid quick --quiet -o mine.csv", 2);
}

TEST(LabPhysicsOwn, WithoutAnAnswerTheReferencesOwnErrorIsPrinted) {
  const LabWorkspace files;
  files.Write("my.toml", kBall);
  const std::string said = RunIn(files, "physics my.toml --grid quick --quiet -o t.csv", 0);
  EXPECT_NE(said.find("halving the step of the reference changes it by "), std::string::npos)
      << said;
  EXPECT_NE(said.find(" m: converged"), std::string::npos) << said;
  const CsvTable table = CsvTable::Load(files / "t.csv");
  EXPECT_EQ(table.Text(0, "truth"), "converged");
  EXPECT_EQ(table.Text(0, "failure"), "");
  // Free fall: y differs by g t (h1 - h2)/2, RMS over t of 1 s.
  EXPECT_NEAR(*table.Number(0, "reference_change"), 5 * (1 / 960.0 - 1 / 1920.0) * 0.587, 2e-4);
}

TEST(LabPhysicsOwn, TheTableSaysNotConvergedWhenHalvingDoesNotHelp) {
  const LabWorkspace files;
  files.Write("my.toml", kChaos);
  const std::string said = RunIn(files, "physics my.toml --grid quick --quiet", 0);
  EXPECT_NE(said.find("not converged"), std::string::npos) << said;
  EXPECT_NE(said.find("my: no front, no setting held: not converged"), std::string::npos) << said;
  EXPECT_EQ(said.find("chaos"), std::string::npos) << said;
  const CsvTable table = CsvTable::Load(files / "out/physics/my/physics.csv");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    EXPECT_EQ(table.Text(row, "failure"), "not converged");
    EXPECT_GT(*table.Number(row, "error"), 0);
  }
  EXPECT_NE(files.Read("out/physics/my/tables/hard-cases.md").find(", not converged |"),
            std::string::npos);
}

TEST(LabPhysicsOwn, MistakesAreOneLineAndNothingIsWritten) {
  const LabWorkspace files;
  files.Write("my.toml",
              std::string(kBall) + "[[script]]\nname = \"t\"\ncode = 'function exact(t) end'\n");
  files.Write("no-scene.toml", "hello\n");
  const auto refused = [&](const std::string& words) { return RunIn(files, words, 2); };
  EXPECT_EQ(refused("physics my.toml").rfind("seam-lab: my.toml:8: exact(0): ", 0), 0u);
  EXPECT_EQ(refused("physics none.toml"), "seam-lab: none.toml: no such scene file\n");
  EXPECT_EQ(refused("physics no-scene.toml").rfind("seam-lab: no-scene.toml:1: ", 0), 0u);
  EXPECT_EQ(refused("physics"), "seam-lab: -o FILE says where the table goes\n");
  EXPECT_EQ(files.Names(), (std::vector<std::string>{"my.toml", "no-scene.toml"}));
}

TEST(LabPhysicsOwn, TuneUsesTheScenesAnswerToo) {
  const LabWorkspace files;
  files.Write("my.toml", std::string(kBall) + kTruth);
  const std::string said = RunIn(files, "tune my.toml --error 0.03", 0);
  EXPECT_NE(said.find("case my: worst distance of any point"), std::string::npos) << said;
  EXPECT_NE(said.find("best"), std::string::npos) << said;
}

TEST(Reference, IsConvergedWhenItsOwnErrorIsAQuarterOfStocksOrBelowRounding) {
  Reference reference{Trajectory(ParseScene(kBall, "made-up.toml")), 0.02, 0.1};
  EXPECT_TRUE(reference.converged());
  reference.stock_m = 0.07;
  EXPECT_FALSE(reference.converged());
  reference.change_m = reference.stock_m = 1e-6;
  EXPECT_TRUE(reference.converged()) << "all rest where they lay";
  reference.change_m = NAN;
  EXPECT_FALSE(reference.converged());
}

}  // namespace lab_exact_command_test
}  // namespace seam
