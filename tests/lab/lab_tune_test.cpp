/// seam-lab tune and overhead: the cheapest setting of a known problem is found; the core and the
/// engine alone end in the same state.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "common/scene/scene_limits.h"
#include "tests/lab/hard/overhead.h"
#include "tests/lab/hard/physics_plan.h"
#include "tests/lab/hard/raw_box2d.h"
#include "tests/lab/hard/settings.h"
#include "tests/lab/hard/tune.h"
#include "tests/support/child_process.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace lab_tune_test {

TEST(Settings, AreWrittenAsTheSceneFileReadsThem) {
  for (const GridSize size : {GridSize::kReport, GridSize::kFull}) {
    std::set<std::string> all;
    for (const Solver& solver : GridSettings(size, Solver{})) {
      const std::string lines = SolverLines(solver);
      EXPECT_TRUE(all.insert(lines).second) << "twice: " << lines;
      const Scene scene = ParseScene(lines + "[[part]]\nname = \"b\"\ncircle = 0.5\n", "s.toml");
      EXPECT_TRUE(SameSolver(scene.solver, solver)) << lines;
    }
  }
  Solver odd;
  odd.sleep = odd.continuous = odd.warm_starting = false;
  odd.weld_joints = true;
  odd.skin = 0.004f;
  const Scene scene =
      ParseScene(SolverLines(odd) + "[[part]]\nname = \"b\"\ncircle = 0.5\n", "s.toml");
  EXPECT_TRUE(SameSolver(scene.solver, odd));
  EXPECT_FALSE(SameSolver(scene.solver, Solver{}));
}

TEST(Settings, AScriptKeepsItsTimesAtAnotherRate) {
  const Scene scene = LoadScene("scenes/stack.toml");  // 3.0 s and 3.1 s at 60 Hz
  Solver fast = scene.solver;
  fast.tick_hz = 240;
  const Scene changed = WithSolver(scene, fast);
  EXPECT_EQ(scene.players[0].script[1].from_tick * 4, changed.players[0].script[1].from_tick);
  EXPECT_EQ(changed.players[0].script[2].from_tick, 744);
  EXPECT_EQ(changed.solver.tick_hz, 240);
}

/// A problem whose error depends on the rate alone, 1.5/rate, and for `needed` iterations also on
/// those: below them it never passes.
TuneProblem MadeUpProblem(double limit, int needed) {
  TuneProblem problem;
  problem.run = [needed](Trial* trial) {
    const Solver& s = trial->solver;
    trial->error = 1.5 / (s.tick_hz * s.substeps);
    if (s.velocity_iterations < needed) trial->failure = "fell";
    trial->run_cost = trial->predicted;
  };
  problem.predicted = [](const Solver& s) {
    return s.tick_hz * s.substeps * (7.0 + s.velocity_iterations + s.position_iterations) +
           (s.skin > 0 ? 1 : 0);
  };
  problem.measured_cost = [cost = problem.predicted](const Solver& s) { return cost(s) / 1080; };
  problem.limit = limit;
  problem.budget = std::numeric_limits<double>::infinity();
  return problem;
}

TEST(Tune, FindsTheCheapestOfAMadeUpProblem) {
  for (const bool keep_hz : {false, true}) {
    for (const int needed : {1, 3, 7}) {
      for (const int rate : {30, 50, 90, 150, 180, 400}) {
        TuneProblem problem = MadeUpProblem(1.5 / rate, needed);
        problem.keep_hz = keep_hz;
        const TuneResult result = Tune(problem);
        ASSERT_TRUE(result.best.has_value());
        EXPECT_TRUE(result.complete);
        // Finds the least cost by trying everything.
        double least = std::numeric_limits<double>::infinity();
        std::vector<int> rates = {20, 30, 60, 120, 240};
        if (keep_hz) rates = {60};
        for (const int hz : rates) {
          const int substeps = std::max(SubstepsMin(hz), (rate + hz - 1) / hz);
          if (substeps <= 8) least = std::min(least, hz * substeps * (8.0 + needed));
        }
        const Trial& best = result.trials[*result.best];
        EXPECT_EQ(best.predicted, least) << SolverWords(best.solver) << " for " << rate << " Hz";
        EXPECT_EQ(best.solver.velocity_iterations, needed);
        EXPECT_TRUE(!keep_hz || best.solver.tick_hz == 60);
        EXPECT_EQ(best.cost, best.predicted / 1080);
      }
    }
  }
}

TEST(Tune, FindsASettingThatCostsLessThanPredicted) {
  // Piles that are solved well sleep at once: from 20 iterations on they cost a tenth.
  TuneProblem problem = MadeUpProblem(1.5 / 60, 5);
  problem.measured_cost = [cost = problem.predicted](const Solver& s) {
    return cost(s) * (s.velocity_iterations >= 20 ? 0.1 : 1);
  };
  problem.run = [run = problem.run, cost = problem.measured_cost](Trial* trial) {
    run(trial);
    trial->run_cost = cost(trial->solver);
  };
  const TuneResult alone = Tune(problem);
  ASSERT_TRUE(alone.best.has_value());
  EXPECT_EQ(alone.trials[*alone.best].solver.velocity_iterations, 5) << "too far away to be seen";
  problem.own.velocity_iterations = 24;
  const TuneResult result = Tune(problem);
  ASSERT_TRUE(result.best.has_value());
  const Trial& best = result.trials[*result.best];
  EXPECT_EQ(best.solver.velocity_iterations, 20);
  EXPECT_EQ(best.solver.position_iterations, 1);
  EXPECT_EQ(best.solver.tick_hz * best.solver.substeps, 60);
}

TEST(Tune, OneOutlierTimingDoesNotDecide) {
  TuneProblem problem = MadeUpProblem(1.5 / 60, 1);
  bool odd = true;
  problem.measured_cost = [&odd, cost = problem.measured_cost](const Solver& s) {
    const bool half = odd && s.velocity_iterations == 2;
    if (half) odd = false;
    return cost(s) * (half ? 0.5 : 1);
  };
  const TuneResult result = Tune(problem);
  ASSERT_FALSE(odd) << "it was timed";
  ASSERT_TRUE(result.best.has_value());
  EXPECT_EQ(result.trials[*result.best].solver.velocity_iterations, 1);
}

TEST(Tune, TriesExactAndIterativeJointsIfTheSceneHasJoints) {
  TuneProblem problem = MadeUpProblem(1.5 / 60, 1);
  problem.jointed = true;
  problem.run = [run = problem.run](Trial* trial) {
    run(trial);
    const bool exact = trial->solver.joints == JointSolving::kExact;
    if (!exact || trial->solver.joint_substeps != 2) trial->failure = "tore";
  };
  const TuneResult result = Tune(problem);
  ASSERT_TRUE(result.best.has_value());
  EXPECT_EQ(result.trials[*result.best].solver.joints, JointSolving::kExact);
  EXPECT_EQ(result.trials[*result.best].solver.joint_substeps, 2);
  int iterative = 0;
  for (const Trial& trial : result.trials) {
    iterative += trial.solver.joints == JointSolving::kIterative ? 1 : 0;
  }
  EXPECT_GT(iterative, 10);
}

TEST(Tune, ItsFrontFallsInErrorAsItRisesInCost) {
  const TuneResult result = Tune(MadeUpProblem(1.5 / 240, 2));
  ASSERT_GE(result.front.size(), 3u);
  for (std::size_t i = 1; i < result.front.size(); ++i) {
    EXPECT_LT(result.trials[result.front[i]].error, result.trials[result.front[i - 1]].error);
    EXPECT_GE(*result.trials[result.front[i]].cost, *result.trials[result.front[i - 1]].cost);
  }
  for (const std::size_t i : result.front) EXPECT_EQ(result.trials[i].failure, "");
  EXPECT_EQ(std::count(result.front.begin(), result.front.end(), *result.best), 1);
}

TEST(Tune, ReportsWhenNothingReachesTheTarget) {
  const TuneResult none = Tune(MadeUpProblem(1e-9, 1));
  EXPECT_FALSE(none.best.has_value());
  EXPECT_TRUE(none.complete);
  EXPECT_GT(none.trials.size(), 200u) << "the whole coarse grid";
  EXPECT_FALSE(none.front.empty());
  TuneProblem bounded = MadeUpProblem(1e-9, 1);
  bounded.budget = 20000;
  const TuneResult cut = Tune(bounded);
  EXPECT_FALSE(cut.complete);
  double spent = 0;
  for (const Trial& trial : cut.trials) spent += trial.predicted;
  EXPECT_LE(spent, 20000);
  EXPECT_GT(spent, 15000);
}

std::string OutputOf(const std::vector<std::string>& words, int status) {
  std::vector<std::string> all = {LabProgram()};
  all.insert(all.end(), words.begin(), words.end());
  ChildProcess lab(all);
  EXPECT_TRUE(lab.Wait(120));
  EXPECT_EQ(lab.exit_status(), status) << lab.output();
  return lab.output();
}

TEST(LabTune, PrintsLinesToPasteOrThatNoneReachesIt) {
  const LabWorkspace files;
  // Free fall of 1 s: the error at rate 1/h is g t h/2, RMS over t: 2.9 h, at 120 Hz 0.024 m.
  files.Write("fall.toml",
              "duration = 1\n[[part]]\nname = \"ball\"\ncircle = 0.5\n"
              "position = [0, 20]\n");
  const std::string found =
      OutputOf({"tune", files / "fall.toml", "--error", "0.03", "--keep-hz"}, 0);
  // Iterations cost nothing without contacts: the clock decides which of them it names.
  EXPECT_NE(found.find("\n[solver]\nsubsteps = 2\nvelocity_iterations = "), std::string::npos)
      << found;
  const std::string none =
      OutputOf({"tune", files / "fall.toml", "--error", "1e-5", "--keep-hz"}, 1);
  EXPECT_NE(none.find("none reaches 1e-05 m"), std::string::npos) << none;
  EXPECT_NE(none.find("warning: 1e-05 m is less than that"), std::string::npos) << none;
  OutputOf({"tune", files / "none.toml", "--error", "1"}, 2);
  OutputOf({"tune", files / "fall.toml", "--error", "-1"}, 2);
  OutputOf({"tune", files / "fall.toml", "--error", "1", "--case", "none"}, 2);
}

TEST(Overhead, TheCoreAndTheEngineAloneEndInTheSameState) {
  for (const char* name : {"crossing", "cradle", "stack"}) {
    const Scene scene = LoadScene(std::string("scenes/") + name + ".toml");
    const Overhead o = MeasureOverhead(scene, 250, 5);
    EXPECT_TRUE(o.equal) << name;
    EXPECT_GT(o.raw_us_per_step, 0.05) << name;
    EXPECT_GT(o.core_us_per_step, 0.05) << name;
    EXPECT_LT(o.ratio(), 3) << name;
  }
  // And a difference would be seen: a player's push in the raw world alone.
  const Scene scene = LoadScene("scenes/stack.toml");
  RawBox2d pushed(scene), left(scene);
  pushed.Act(0, 0);
  EXPECT_EQ(RawBox2d(scene).Hash(), left.Hash());
  EXPECT_NE(pushed.Hash(), left.Hash());
}

TEST(LabOverhead, WritesARowForEachSceneAndResumes) {
  const LabWorkspace files;
  OutputOf({"overhead", "scenes/cradle.toml", "-o", files / "o.csv", "--repeats", "1"}, 0);
  const std::string one = files.Read("o.csv");
  EXPECT_EQ(one.rfind("scene,bodies,raw_us_per_step,core_us_per_step,ratio,valid\n"
                      "scenes/cradle.toml,5,",
                      0),
            0u)
      << one;
  OutputOf({"overhead", "scenes/cradle.toml", "scenes/crossing.toml", "-o", files / "o.csv",
            "--repeats", "1"},
           0);
  const std::string two = files.Read("o.csv");
  EXPECT_EQ(two.rfind(one + "scenes/crossing.toml,4,", 0), 0u) << two;
  OutputOf({"overhead", "scenes/none.toml", "-o", files / "p.csv"}, 2);
  EXPECT_EQ(files.Names(), std::vector<std::string>{"o.csv"}) << "nothing is written";
}

}  // namespace lab_tune_test
}  // namespace seam
