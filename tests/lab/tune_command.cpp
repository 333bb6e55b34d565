#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/nearest.h"
#include "common/base/progress_count.h"
#include "tests/lab/commands.h"
#include "tests/lab/exact/scene_case.h"
#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/physics_plan.h"
#include "tests/lab/hard/settings.h"
#include "tests/lab/hard/tune.h"

namespace seam {
namespace {

/// The horizon of a scene that is no hard case, unless its duration is shorter. s
constexpr double kHorizon = 10;
/// Bodies nudged for the floor.
constexpr int kNudgedMax = 5;

/// The hard case that is meant: by name, or the first of the scene if it lies in a folder "hard".
const HardCase* CaseOf(const TuneCommand& command) {
  const std::filesystem::path path(command.scene);
  const bool in_hard = std::filesystem::absolute(path).parent_path().filename() == "hard";
  for (const HardCase& hard : HardCases()) {
    if (command.hard.empty() ? in_hard && hard.scene == path.stem().string()
                             : hard.name == command.hard) {
      return &hard;
    }
  }
  if (command.hard.empty()) return nullptr;
  std::vector<std::string> known;
  for (const HardCase& hard : HardCases()) known.push_back(hard.name);
  throw OperatorError("no hard case '" + command.hard + "'" + DidYouMean(command.hard, known));
}

/// Median RMS distance of runs with one body nudged, m: what the scene makes of a micrometre.
double Floor(const Scene& scene, double seconds) {
  const Trajectory path = PathOf(scene, seconds);
  const int bodies = World(scene).body_count();
  const int chosen = std::min(bodies, kNudgedMax);
  std::vector<double> distances;
  for (int k = 0; k < chosen; ++k) {
    distances.push_back(Distance(path, PathOf(scene, seconds, k * bodies / chosen)));
  }
  std::sort(distances.begin(), distances.end());
  return distances.empty() ? 0 : distances[(distances.size() - 1) / 2];
}

/// What is tuned and how its error is found.
struct Target {
  HardCase hard;
  Scene scene;
  double seconds = 0;
  std::unique_ptr<Reference> reference;  // where the case has no judge
};

Target TargetOf(const TuneCommand& command) {
  Target target;
  const HardCase* hard = CaseOf(command);
  if (hard != nullptr) target.hard = *hard;
  target.scene = LoadScene(command.scene);
  if (target.hard.adjust) target.hard.adjust(&target.scene);
  target.seconds = hard != nullptr ? hard->seconds : std::min(kHorizon, target.scene.duration_s);
  if (command.seconds > 0) target.seconds = command.seconds;
  if (hard == nullptr) target.hard = SceneCase(command.scene, target.seconds);
  return target;
}

void Introduce(const TuneCommand& command, Target* target) {
  if (target->hard.judge) {
    std::printf("case %s: %s, %s, over %g s\n", target->hard.name.c_str(),
                target->hard.about.c_str(), target->hard.unit.c_str(), target->seconds);
    return;
  }
  target->reference = std::make_unique<Reference>(MakeReference(target->scene, target->seconds));
  const double change = target->reference->change_m;
  const double floor = Floor(target->scene, target->seconds);
  std::printf(
      "scene %s: %s, %s, over %g s\nhalving that run's step changes it by %.3g m; a nudge of "
      "1e-6 m comes to %.3g m\n",
      target->scene.name.c_str(), target->hard.about.c_str(), target->hard.unit.c_str(),
      target->seconds, change, floor);
  if (command.error < std::max(change, floor)) {
    std::printf(
        "warning: %g m is less than that: not converged, the setting alone does not decide whether "
        "a run comes so close; a shorter --seconds may be decidable\n",
        command.error);
  }
}

void PrintTrial(const char* mark, const Trial& trial) {
  std::printf("%-6s %9s %10.4g  %s%s%s\n", mark,
              trial.cost ? fmt::format("{:.3f}", *trial.cost).c_str() : "", trial.error,
              SolverWords(trial.solver).c_str(), trial.failure.empty() ? "" : ": ",
              trial.failure.c_str());
}

}  // namespace

int RunTune(const TuneCommand& given) {
  TuneCommand command = given;
  command.scene = FindScene(given.scene);
  Target target = TargetOf(command);
  Introduce(command, &target);
  const Scene stock = WithSolver(target.scene, StockSolver());
  const Trajectory* reference = target.reference ? &target.reference->finest : nullptr;
  TuneProblem problem;
  ProgressCount progress("searching", "settings", 0);
  std::int64_t runs = 0;
  problem.run = [&](Trial* trial) {
    progress(runs++);
    const Scene scene = WithSolver(target.scene, trial->solver);
    const Observation seen = Observe(target.hard, scene, target.seconds, reference);
    trial->error = seen.error;
    trial->failure = seen.failure;
    trial->run_cost = seen.cpu_us_per_s;
  };
  problem.predicted = [&](const Solver& solver) {
    return PredictedCpu(target.scene, solver, target.seconds);
  };
  problem.measured_cost = [&](const Solver& solver) {
    return CompareCost(WithSolver(target.scene, solver), stock, target.seconds).ratio;
  };
  problem.own = target.scene.solver;
  problem.jointed = HasJoints(target.scene);
  problem.limit = command.error;
  problem.keep_hz = command.keep_hz;
  problem.budget = command.budget_s;
  const TuneResult result = Tune(problem);
  progress.End();
  std::printf("%-6s %9s %10s\n", "", "cost", "error");
  Trial usual;
  usual.solver = StockSolver();
  usual.cost = 1;
  problem.run(&usual);
  PrintTrial("stock", usual);
  Trial own;
  own.solver = problem.own;
  own.cost = problem.measured_cost(own.solver);
  problem.run(&own);
  PrintTrial("own", own);
  for (const std::size_t i : result.front) {
    if (result.best != i) PrintTrial("front", result.trials[i]);
  }
  if (result.best) PrintTrial("best", result.trials[*result.best]);
  std::printf("%zu settings run%s\n", result.trials.size(),
              result.complete ? "" : "; the rest of the grid is beyond --budget");
  if (!result.best) {
    std::printf("none reaches %g %s\n", command.error, target.hard.unit.c_str());
    return 1;
  }
  const Trial& best = result.trials[*result.best];
  std::printf("the cheapest with at most %g %s, %.3f times stock's cost:\n\n%s", command.error,
              target.hard.unit.c_str(), *best.cost, SolverLines(best.solver).c_str());
  return 0;
}

}  // namespace seam
