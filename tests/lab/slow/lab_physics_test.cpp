/// seam-lab physics: observations of runs with a known course, and its table.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "common/base/check.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/physics_plan.h"
#include "tests/lab/hard/settings.h"
#include "tests/lab/physics_row.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_physics_test {

const char* const kGround = "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n";
const char* const kBall =
    "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 0.5]\nfriction = 0\n";

Scene SceneOf(const std::string& parts, const std::string& solver = "") {
  return ParseScene("[solver]\n" + solver + "\n" + parts, "made-up.toml");
}

/// The x of the first body.
class PlaceJudge : public Judge {
 public:
  void See(const World& world) override {
    x_ = std::fabs(static_cast<double>(world.Read(0).position.x()));
    ++seen_;
    if (world.tick() != seen_ - 1) throw OperatorError("not seen after every tick");
  }
  double Error() const override { return x_; }
  std::string Failure() const override { return x_ > 1 ? "left, \"far\"" : ""; }

 private:
  double x_ = 0;
  std::int64_t seen_ = 0;
};

HardCase MadeUp(double seconds) {
  HardCase hard;
  hard.name = "made-up";
  hard.scene = "made-up";
  hard.unit = "m";
  hard.seconds = seconds;
  hard.judge = [](const Scene&) { return std::make_unique<PlaceJudge>(); };
  return hard;
}

TEST(Observe, ABallAtRestSleepsAfterHalfASecondWithoutFaults) {
  const Scene scene = SceneOf(std::string(kGround) + kBall, "skin = 0.0025");
  const Observation seen = Observe(MadeUp(10), scene, 10);
  EXPECT_EQ(seen.error, 0);
  EXPECT_EQ(seen.failure, "");
  EXPECT_FALSE(seen.diverged);
  EXPECT_EQ(seen.seconds, 10);
  EXPECT_NEAR(seen.penetration_m, 0, 1e-3);
  EXPECT_EQ(seen.joint_drift_m, 0);
  EXPECT_EQ(seen.jitter_mps, 0);
  ASSERT_TRUE(seen.asleep_s.has_value());
  EXPECT_NEAR(*seen.asleep_s, 0.5, 0.05);  // the engine's time to sleep
  ASSERT_TRUE(seen.energy_gain.has_value());
  EXPECT_NEAR(*seen.energy_gain, 0, 1e-3);
}

TEST(Observe, ABodyInSteadyFlightJittersWithItsSpeedAndNeverSleeps) {
  const Scene scene =
      ParseScene(std::string("gravity = [0, 0]\n") + kBall + "velocity = [3, 4]\n", "made-up.toml");
  const Observation seen = Observe(MadeUp(6), scene, 6);
  EXPECT_NEAR(seen.error, 18, 1e-3);
  EXPECT_EQ(seen.failure, "left, \"far\"");
  EXPECT_NEAR(seen.jitter_mps, 5, 1e-5);
  EXPECT_FALSE(seen.asleep_s.has_value());
  EXPECT_NEAR(*seen.energy_gain, 0, 1e-6);
}

TEST(Observe, PenetrationIsTheDeepestBeyondTheInitialOne) {
  // Without continuous collision two steps take it 2 v h + 3 g h^2 down, from 0.3 m above.
  const std::string diver =
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 0.8]\nvelocity = [0, -12]\n";
  const Scene scene = SceneOf(kGround + diver, "continuous = false");
  EXPECT_NEAR(Observe(MadeUp(2), scene, 2).penetration_m, 0.4 + 30 / 3600.0 - 0.3, 1e-4);
  const std::string pair =
      "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
      "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [0, 1.45]\n";
  const Observation apart = Observe(MadeUp(2), SceneOf(kGround + pair, "skin = 0.0025"), 2);
  EXPECT_NEAR(apart.penetration_m, 0, 1e-3) << "5 cm at the start, and from then on less";
  // The upper one is lifted by those 5 cm: m g 0.05 m of 2 m g 1 m.
  EXPECT_NEAR(*apart.energy_gain, 0.025, 0.003);
}

TEST(Observe, JointDriftIsTheExcessOverTheInitialOne) {
  // The rod is 1 m, the ball is placed 1.3 m away: it is pulled in, and 0.3 m was the start's.
  const Scene scene = SceneOf(
      "[[part]]\nname = \"hook\"\nbox = [0.2, 0.2]\nposition = [0, 5]\nanchored = true\n"
      "[[part]]\nname = \"ball\"\ncircle = 0.2\nposition = [0, 3.7]\n"
      "[[joint]]\nname = \"rod\"\nkind = \"distance\"\na = \"hook\"\nb = \"ball\"\nlength = 1\n");
  EXPECT_NEAR(Observe(MadeUp(2), scene, 2).joint_drift_m, 0, 1e-3);
}

TEST(Observe, ABodyBeyondAMillionMetresHasDiverged) {
  Scene scene = ParseScene(std::string("gravity = [0, 0]\n") + kBall + "velocity = [100, 0]\n",
                           "made-up.toml");
  scene.parts[0].position.x() = 1e6f - 10;
  const Observation seen = Observe(MadeUp(3), scene, 3);
  EXPECT_TRUE(seen.diverged);
  EXPECT_TRUE(std::isinf(seen.error));
  EXPECT_NEAR(seen.seconds, 0.1, 0.02);
  EXPECT_EQ(seen.failure, "left, \"far\"") << "the judge's word, if it has one";
}

TEST(Observe, EnergyThatPlayersOrMotorsFeedIsNoGain) {
  const std::string player =
      "[[player]]\nname = \"ann\"\nscript = [[0.5, {buttons = [0]}]]\n"
      "actions = [{button = 0, part = \"ball\", impulse = [0, 3]}]\n";
  const Scene pushed = SceneOf(std::string(kGround) + kBall + player);
  EXPECT_FALSE(Observe(MadeUp(1), pushed, 1).energy_gain.has_value());
  const double mass = 3.14159265 / 4;
  const Trajectory path = PathOf(pushed, 1);
  // Pressed in the step that ends at 0.5 s: h = 1/60 s, v0 = J/m, after 1/6 s that is 11 steps.
  const double h = 1 / 60.0, v0 = 3 / mass;
  EXPECT_NEAR(path.At(20)[0].y() - path.At(14)[0].y(), 11 * h * v0 - 10 * h * h * 66, 2e-3);
}

TEST(Observe, TheScaleOfEnergyIsTheStartsMotionAndAMetresFall) {
  const double mass = 3.14159265 / 4;
  const Scene moving = SceneOf(std::string(kGround) + kBall + "velocity = [2, 0]\nspin = 4\n");
  EXPECT_NEAR(EnergyScale(moving), mass * (2 + 10) + mass * 0.25 / 2 * 16 / 2, 1e-4);
  const Scene still = ParseScene(std::string("gravity = [0, 0]\n") + kBall, "made-up.toml");
  EXPECT_NEAR(EnergyScale(still), mass / 2, 1e-6);
}

TEST(Trajectory, FreeFallAtTwoRatesDiffersByTheIntegratorsError) {
  // y_n = y0 - g t (t + h)/2: at the same t they differ by g t (h1 - h2)/2.
  const std::string ball = "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 500]\n";
  const auto fall = [&](int hz) {
    return PathOf(SceneOf(ball, "tick_hz = " + std::to_string(hz)), 2);
  };
  double squares = 0;
  for (int k = 1; k <= 60; ++k) squares += (k / 30.0) * (k / 30.0) / 60;
  const auto expected = [&](double h1, double h2) { return 5 * (h1 - h2) * std::sqrt(squares); };
  EXPECT_NEAR(Distance(fall(60), fall(240)), expected(1 / 60.0, 1 / 240.0), 1e-4);
  EXPECT_NEAR(Distance(fall(30), fall(120)), expected(1 / 60.0, 1 / 120.0), 1e-4);  // x 2
  EXPECT_EQ(Distance(fall(60), fall(60)), 0);
  const Reference reference = MakeReference(SceneOf(ball), 2);
  EXPECT_NEAR(reference.change_m, expected(1 / 960.0, 1 / 1920.0), 5e-4);
  HardCase hard = MadeUp(2);
  hard.judge = nullptr;
  const Observation seen = Observe(hard, SceneOf(ball), 2, &reference.finest);
  EXPECT_NEAR(seen.error, expected(1 / 60.0, 1 / 1920.0), 5e-4);
  // At 50 Hz every fifth tick is a multiple of 1/30 s: the mean is over those.
  double fifths = 0;
  for (int k = 1; k <= 20; ++k) fifths += (k / 10.0) * (k / 10.0) / 20;
  EXPECT_EQ(CommonHz(50), 10);
  EXPECT_NEAR(Distance(fall(50), fall(240)), 5 * (1 / 100.0 - 1 / 240.0) * std::sqrt(fifths),
              1e-4);  // x 2
}

TEST(Trajectory, ComparesPartsWhetherWeldsAreJointsOrOneBody) {
  const std::string parts =
      "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 100]\nspin = 2\n"
      "[[part]]\nname = \"b\"\nbox = [1, 0.5]\nposition = [1, 100]\n"
      "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\nanchor = [0.5, 100]\n";
  const Scene rigid = SceneOf(parts);
  Scene jointed = SceneOf(parts, "welds = \"joint\"\njoints = \"iterative\"");
  const Trajectory path = PathOf(rigid, 1);
  ASSERT_EQ(path.parts(), 2u);
  EXPECT_NEAR((path.At(15)[1] - path.At(15)[0]).norm(), 1, 1e-5) << "they turn as one";
  EXPECT_GT((path.At(15)[1] - path.At(15)[0] - Eigen::Vector2d(1, 0)).norm(), 0.5);
  jointed.parts[0].spin = 0;
  Scene still = rigid;
  still.parts[0].spin = 0;
  EXPECT_LT(Distance(PathOf(still, 1), PathOf(jointed, 1)), 1e-3);
}

TEST(CompareCost, IsOneForTheSameSettingAndGrowsWithTheSubsteps) {
  const Scene scene = SceneOf(std::string(kGround) +
                                  "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
                                  "repeat = {count = 10, step = [0, 1]}\n",
                              "skin = 0.0025\nsleep = false");
  Scene dear = scene;
  dear.solver.substeps = 8;
  // Wide: other programs share the caches.
  EXPECT_NEAR(CompareCost(scene, scene, 1).ratio, 1, 0.3);
  const Cost cost = CompareCost(dear, scene, 1);
  EXPECT_GT(cost.ratio, 4);
  EXPECT_GT(cost.stock_us_per_s, 0);
  EXPECT_NEAR(cost.us_per_s / cost.stock_us_per_s / cost.ratio, 1, 0.3);
}

/// The texts by column, without cpu_us_per_s, stock_cpu_us_per_s and cost_ratio.
std::map<std::string, std::string> WithoutCpu(const Values& values) {
  std::map<std::string, std::string> texts;
  for (const Value& value : values) texts[value.column] = value.text;
  for (const char* cpu : {"cpu_us_per_s", "stock_cpu_us_per_s", "cost_ratio"}) {
    EXPECT_EQ(texts.erase(cpu), 1u) << cpu;
  }
  return texts;
}

TEST(PhysicsRow, DependsOnThePointAloneExceptForCpu) {
  HardCase hard = MadeUp(1);
  PhysicsPoint point{&hard, "grid",
                     SceneOf(std::string(kGround) + kBall + "velocity = [2, 0]\n",
                             "substeps = 2\nskin = 0.0025\nwarm_starting = false")};
  const Values key = PhysicsKey(point), row = PhysicsValues(point, nullptr);
  EXPECT_EQ(CsvColumns(key), PhysicsKeyColumns());
  EXPECT_EQ(CsvColumns(row), PhysicsValueColumns());
  EXPECT_EQ(CsvColumns(CrashedValues("crashed: Aborted")), PhysicsValueColumns());
  EXPECT_EQ(CsvRow(CrashedValues("crashed: Aborted")), "inf,crashed: Aborted,,,,,,,,,,");
  EXPECT_EQ(CsvRow(Values(key.begin() + 1, key.end())),
            "made-up,invariant,m,grid,60,2,8,3,off,0.0025,on,body,auto,2,engine,1,1");
  std::map<std::string, std::string> texts = WithoutCpu(row);
  EXPECT_NEAR(std::stod(texts["error"]), 2, 1e-3);
  EXPECT_EQ(texts["failure"], "left, \"far\"");
  EXPECT_EQ(WithoutCpu(PhysicsValues(point, nullptr)), texts);
  const Reference reference = MakeReference(point.scene, 1);
  texts = WithoutCpu(PhysicsValues(point, &reference));
  EXPECT_NE(texts["reference_change"], "");
  EXPECT_EQ(texts["valid"], "");
  hard.truth = Truth::kConverged;
  texts = WithoutCpu(PhysicsValues(point, nullptr));
  EXPECT_EQ(texts["valid"], "no converged run");
  EXPECT_EQ(texts["error"], "");
}

TEST(PhysicsPlan, SpendsACasesBudgetOnAwakeBodies) {
  const LabWorkspace files;
  const std::string pile =
      "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0.51]\n"
      "repeat = {count = 200, step = [2, 0]}\nfriction = 0\n";
  const std::string ground = "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [900, 0]]\n";
  files.Write("made-up.toml", ground + pile);
  HardCase hard = MadeUp(20);
  const auto plan_of = [&](GridSize size, double* awake) {
    *awake = AwakeShare(hard, size, files / "");
    return PlanPhysics({&hard}, size, {*awake}, files / "");
  };
  double awake = 0;
  const PhysicsPlan resting = plan_of(GridSize::kReport, &awake);
  EXPECT_NEAR(awake, 0.6 / 20, 0.02) << "they settle and sleep after half a second";
  files.Write("made-up.toml", ground + pile + "velocity = [0.3, 0]\n");
  const PhysicsPlan gliding = plan_of(GridSize::kReport, &awake);
  EXPECT_EQ(awake, 1);
  for (const PhysicsPlan* plan : {&resting, &gliding}) {
    ASSERT_GE(plan->points.size(), 3u);
    EXPECT_EQ(plan->points[0].role, "stock");
    EXPECT_TRUE(SameSolver(plan->points[0].scene.solver, StockSolver()));
    EXPECT_EQ(plan->points[1].role, "scene");
    EXPECT_EQ(plan->points[2].role, "grid");
  }
  EXPECT_GT(resting.points.size(), 2 * gliding.points.size());
  EXPECT_EQ(gliding.left_out.size(), 1u);
  // 20 s of 200 boxes at 60 Hz: 0.5 CPU s of kQuick's 2. For 100 s all of it is left out.
  EXPECT_EQ(plan_of(GridSize::kQuick, &awake).points[1].role, "scene");
  hard.seconds = 100;
  EXPECT_TRUE(plan_of(GridSize::kQuick, &awake).points.empty());
}

std::string RunLab(const std::vector<std::string>& words, int status) {
  ChildProcess lab(words);
  EXPECT_TRUE(lab.Wait(120));
  EXPECT_EQ(lab.exit_status(), status) << lab.output();
  return lab.output();
}

std::vector<std::map<std::string, std::string>> RowsWithoutCpu(const std::string& table) {
  const CsvTable csv = CsvTable::Parse(table, "physics.csv");
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    Values values;
    for (const std::string& column : csv.header()) {
      values.push_back({column, csv.Text(row, column)});
    }
    rows.push_back(WithoutCpu(values));
  }
  return rows;
}

TEST(LabPhysics, AKilledRunResumesToTheSameTableExceptForCpu) {
  const LabWorkspace files;
  const auto words = [&](const char* table) {
    return std::vector<std::string>{LabProgram(), "physics", "--cases", "tower-10,scissor-lift",
                                    "--grid",     "quick",   "-o",      files / table,
                                    "--jobs",     "2"};
  };
  const std::string said = RunLab(words("whole.csv"), 0);
  EXPECT_NE(said.find("tower-10 "), std::string::npos) << said;
  const auto whole = RowsWithoutCpu(files.Read("whole.csv"));
  const std::size_t rows = whole.size();
  ASSERT_GE(rows, 8u);  // how many depends on which settings of the grid are the scene's own
  const std::string all = fmt::format("{} of {} rows, {} of them new", rows, rows, rows);
  EXPECT_NE(said.find(all), std::string::npos) << said;
  EXPECT_EQ(whole[0].at("role"), "stock");
  EXPECT_EQ(whole[1].at("role"), "scene");
  EXPECT_EQ(whole[2].at("role"), "grid");
  ChildProcess lab(words("t.csv"));
  for (int i = 0; i < 5000; ++i) {  // until some rows are there
    const std::string text = files.Read("t.csv");
    if (std::count(text.begin(), text.end(), '\n') >= 3) break;
    usleep(2000);
  }
  lab.Stop(SIGKILL);
  const std::string part = files.Read("t.csv");
  EXPECT_LE(std::count(part.begin(), part.end(), '\n'), static_cast<long>(rows));
  RunLab(words("t.csv"), 0);
  EXPECT_EQ(RowsWithoutCpu(files.Read("t.csv")), whole);
  const std::string resumed = files.Read("t.csv");
  for (std::size_t at = 0, end; (end = part.find('\n', at)) != std::string::npos; at = end + 1) {
    EXPECT_NE(resumed.find(part.substr(at, end + 1 - at)), std::string::npos) << "not run again";
  }
}

TEST(LabPhysics, MistakesAreReportedAndNothingIsWritten) {
  const LabWorkspace files;
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {LabProgram(), "physics", "-o", files / "t.csv"};
    words.insert(words.end(), more.begin(), more.end());
    return RunLab(words, 2);
  };
  const std::string unknown = refused({"--cases", "tower-10,tower-1000"});
  EXPECT_NE(unknown.find("no hard case 'tower-1000' (there are "), std::string::npos) << unknown;
  refused({"--grid", "huge"});
  refused({"--scenes", files / "none"});
  EXPECT_TRUE(files.Names().empty());
}

}  // namespace lab_physics_test
}  // namespace seam
