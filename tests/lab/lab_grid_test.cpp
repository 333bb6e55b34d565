/// Sweep files: all their combinations in their order, what they set, and their mistakes.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "tests/lab/experiment/build_id.h"
#include "tests/lab/grid.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_grid_test {

Grid GridOf(const LabWorkspace& files, const std::string& text) {
  files.Write("sweep.toml", text);
  return ReadGrid(files / "sweep.toml");
}

TEST(Grid, CombinesEverythingWithSeedsFastestAndScenesSlowest) {
  const LabWorkspace files;
  const Grid grid = GridOf(files, R"(
scenes = ["scenes/crossing.toml", "scenes/cradle.toml"]
methods = ["strict", "buffer/fade", "buffer"]
impair = ["perfect", "loss=1%,jitter=5ms"]
one_way_ms = [50, 100]
send_hz = [20, 30]
drive = ["script", "bot"]
smooth = ["on", "off"]
seeds = {from = 7, count = 3}
duration = 2.5
floor = false
)");
  ASSERT_EQ(grid.points.size(), 2u * 3 * 4 * 2 * 2 * 2 * 3);
  EXPECT_FALSE(grid.floor);
  EXPECT_EQ(grid.points[0].settings.seed, 7);
  EXPECT_EQ(grid.points[1].settings.seed, 8);
  EXPECT_EQ(grid.points[3].settings.smooth, "off");
  EXPECT_EQ(grid.points[6].settings.drive, "bot");
  EXPECT_EQ(grid.points[12].settings.send_hz, 30);
  EXPECT_EQ(grid.points[0].settings.impair, "delay=50ms");
  EXPECT_EQ(grid.points[24].settings.impair, "delay=100ms");
  EXPECT_EQ(grid.points[48].settings.impair, "delay=50ms,loss=1%,jitter=5ms");
  EXPECT_EQ(grid.points[0].settings.mode, "strict");
  EXPECT_EQ(grid.points[96].settings.reconcile, "fade");
  EXPECT_EQ(grid.points[192].settings.reconcile, "rollback") << "the default has its name";
  EXPECT_EQ(grid.points[288].settings.scene, "scenes/cradle.toml");
  const std::string hash = fmt::format(
      "{:016x}", Fnv1a(grid.points[48].scene->text.data(), grid.points[48].scene->text.size()));
  EXPECT_EQ(grid.points[48].key,
            kLabVersion + "," + BuiltCommit() + "," + Numerics() + ",scenes/crossing.toml," + hash +
                ",,strict,,\"delay=50ms,loss=1%,jitter=5ms\",20,script,on,2.5,7");
}

TEST(Grid, ThePredictionOfCentralIsPartOfTheMethodAndTheKey) {
  const LabWorkspace files;
  const Grid grid = GridOf(files,
                           "scenes = \"scenes/crossing.toml\"\n"
                           "methods = [\"central/own\", \"central\"]\n"
                           "input_delay = [0, 4]\n");
  ASSERT_EQ(grid.points.size(), 4u);
  EXPECT_EQ(grid.points[0].settings.predict, "own");
  EXPECT_EQ(grid.points[1].settings.predict, "all") << "the default has its name";
  EXPECT_EQ(grid.points[1].settings.reconcile, "");
  EXPECT_NE(grid.points[0].key.find(",central,own,"), std::string::npos) << grid.points[0].key;
  EXPECT_NE(grid.points[1].key.find(",central,all,"), std::string::npos) << grid.points[1].key;
  EXPECT_EQ(grid.points[0].scene->input_delay_ticks, 0);
  EXPECT_EQ(grid.points[2].scene->input_delay_ticks, 4);
  const std::string values = CsvRow(PointValues(grid.points[2]));
  EXPECT_EQ(values.substr(values.rfind(',')), ",4") << "input_delay_ticks is the last column";
  for (const char* wrong : {"[\"central/most\"]", "[\"strict/own\"]", "[\"buffer/own\"]",
                            "[\"central/fade\"]", "[\"central\", \"central/all\"]"}) {
    EXPECT_THROW(
        GridOf(files, std::string("scenes = \"scenes/crossing.toml\"\nmethods = ") + wrong),
        OperatorError)
        << wrong;
  }
}

TEST(Grid, SetsTheScenesNumbersAndComposesTheNetwork) {
  const LabWorkspace files;
  const Grid grid = GridOf(files, R"(
scenes = "scenes/crossing.toml"
set = ["", "solver.continuous=false; gravity=[0, -9]"]
substeps = [1, 4]
skin = [0.0025]
buffer_m = [5, 7.5]
one_way_ms = [50]
jitter_ms = [0, 12]
loss_percent = [2.5]
)");
  ASSERT_EQ(grid.points.size(), 2u * 2 * 2 * 2);
  EXPECT_EQ(grid.points[0].settings.impair, "delay=50ms,jitter=0ms,loss=2.5%");
  EXPECT_EQ(grid.points[1].settings.impair, "delay=50ms,jitter=12ms,loss=2.5%");
  EXPECT_EQ(grid.points[0].scene->buffer_m, 5);
  EXPECT_EQ(grid.points[2].scene->buffer_m, 7.5f);
  EXPECT_EQ(grid.points[4].scene->solver.substeps, 4);
  EXPECT_TRUE(grid.points[4].scene->solver.continuous);
  EXPECT_FALSE(grid.points[8].scene->solver.continuous);
  EXPECT_EQ(grid.points[8].scene->gravity.y(), -9);
  EXPECT_EQ(grid.points[8].scene->solver.skin, 0.0025f);
  EXPECT_EQ(grid.points[8].settings.set,
            (std::vector<std::string>{"solver.continuous=false", "gravity=[0, -9]",
                                      "solver.substeps=1", "solver.skin=0.0025", "buffer=5"}));
  EXPECT_NE(grid.points[8].key.find(",\"solver.continuous=false;gravity=[0, -9];solver.substeps=1;"
                                    "solver.skin=0.0025;buffer=5\",buffer,rollback,"),
            std::string::npos)
      << grid.points[8].key;
  EXPECT_EQ(CsvRow(PointValues(grid.points[15])), "50,12,2.5,60,4,8,3,0.0025,7.5,0");
  const Grid named = GridOf(files, "scenes = \"scenes/crossing.toml\"\nimpair = \"4g\"");
  // 4g: p = 0.0115 and r = 0.25 lose (0.0115 * 0.8 + 0.25 * 0.005) / 0.2615 of all.
  EXPECT_EQ(CsvRow(PointValues(named.points[0])), "50,20,3.99618,60,1,8,3,,25,0");
}

TEST(Grid, DefaultsAreThoseOfRunWithTheScenesOwnDuration) {
  const LabWorkspace files;
  const Grid grid = GridOf(files, "scenes = \"scenes/crossing.toml\"");
  ASSERT_EQ(grid.points.size(), 1u);
  const SessionSettings& s = grid.points[0].settings;
  EXPECT_EQ(s.impair, SessionSettings().impair);
  EXPECT_EQ(s.seed, SessionSettings().seed);
  EXPECT_EQ(s.send_hz, SessionSettings().send_hz);
  EXPECT_EQ(s.duration_s, LoadScene("scenes/crossing.toml").duration_s);
  EXPECT_TRUE(grid.floor);
}

TEST(Grid, MistakesAreReportedBeforeAnythingRuns) {
  const LabWorkspace files;
  const std::string scene = "scenes = \"scenes/crossing.toml\"\n";
  for (const char* mistake : {"method = [\"strict\"]",
                              "methods = [\"magic\"]",
                              "methods = [\"strict/fade\"]",
                              "methods = [\"buffer/magic\"]",
                              "methods = []",
                              "impair = [\"magic\"]",
                              "send_hz = [0]",
                              "send_hz = [30.5]",
                              "send_hz = 30",
                              "seeds = [-1]",
                              "seeds = [1, 1]",
                              "seeds = {from = 1}",
                              "seeds = {count = 0}",
                              "drive = [\"keyboard\"]",
                              "smooth = [\"perhaps\"]",
                              "duration = -1",
                              "one_way_ms = [50]\nimpair = [\"demo\"]",
                              "one_way_ms = [5]\nimpair = [\"delay=1ms\"]",
                              "floor = 1",
                              "methods = [\"buffer\", \"buffer/rollback\"]",
                              "loss_percent = [101]",
                              "loss_percent = [\"1%\"]",
                              "jitter_ms = []",
                              "substeps = [0]",
                              "substeps = [2, 2]",
                              "skin = [0.5]",
                              "tick_hz = [7]",
                              "buffer_m = [-1]",
                              "buffer_m = 5",
                              "input_delay = [13]",
                              "input_delay = [0.5]",
                              "loss_percent = [1]\nimpair = [\"burst=1%:50%\"]",
                              "jitter_ms = [1]\nimpair = [\"jitter=1ms\"]",
                              "set = [\"solver.magic=1\"]",
                              "set = [\"substeps=2\"]",
                              "set = [\"buffer=1\"]\nbuffer_m = [2]",
                              "set = [\"buffer\"]",
                              "seeds = {count = 1000000}\nsend_hz = [20, 30]",
                              "impair = [\"a\\nb\"]",
                              "seeds ="}) {
    EXPECT_THROW(GridOf(files, scene + mistake), OperatorError) << mistake;
  }
  EXPECT_THROW(GridOf(files, "seeds = [1]"), OperatorError);
  EXPECT_THROW(GridOf(files, "scenes = [\"scenes/none.toml\"]"), OperatorError);
  EXPECT_THROW(ReadGrid(files / "none.toml"), OperatorError);
}

}  // namespace lab_grid_test
}  // namespace seam
