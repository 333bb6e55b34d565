#include "tests/lab/hard/physics_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/assembly.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/scene_limits.h"
#include "tests/lab/hard/script_player.h"

namespace seam {
namespace {

/// CPU seconds of a row: the run that is observed, and those of both settings that are timed.
double RowCost(double own, double stock) {
  return own + std::max(own + stock, std::min(0.15, 15 * (own + stock)));
}

/// As few engine steps as a scene may have: exact joints have substeps of their own.
void AddJointPoints(const HardCase* hard, const Scene& scene, PhysicsPlan* plan) {
  if (!HasJoints(scene)) return;
  Solver solver = scene.solver;
  solver.joints = JointSolving::kIterative;
  if (!SameSolver(solver, scene.solver)) {
    plan->points.push_back({hard, "iterative", WithSolver(scene, solver)});
  }
  const Solver stock = StockSolver();
  solver.joints = JointSolving::kExact;
  solver.substeps = SubstepsMin(solver.tick_hz);
  solver.velocity_iterations = stock.velocity_iterations;
  solver.position_iterations = stock.position_iterations;
  for (const int substeps : hard->exact_substeps) {
    solver.joint_substeps = substeps;
    plan->points.push_back({hard, "exact", WithSolver(scene, solver)});
  }
  // Fewer ticks, as the grid tries them with iterative joints; unless the scene has so few.
  for (const int times : {2, 3}) {
    if (scene.solver.tick_hz == stock.tick_hz / times) continue;
    solver.tick_hz = stock.tick_hz / times;
    solver.substeps = SubstepsMin(solver.tick_hz);
    for (const int substeps : {1, 2}) {
      solver.joint_substeps = substeps;
      plan->points.push_back({hard, "grid", WithSolver(scene, solver)});
    }
  }
}

/// Soft contacts, with two and with four substeps in each of as few engine steps as a scene may
/// have; joints as in the scene.
void AddSoftPoints(const HardCase* hard, const Scene& scene, PhysicsPlan* plan) {
  const Solver stock = StockSolver();
  Solver solver = scene.solver;
  solver.contacts = ContactSolving::kSoft;
  solver.skin = static_cast<float>(kSkinRange.min);
  solver.substeps = SubstepsMin(solver.tick_hz);
  solver.velocity_iterations = stock.velocity_iterations;
  solver.position_iterations = stock.position_iterations;
  for (const int substeps : {2, 4}) {
    solver.contact_substeps = substeps;
    plan->points.push_back({hard, "soft", WithSolver(scene, solver)});
  }
}

/// What sleeps costs little, but the world is looked through.
double SleptThrough(double awake) { return 0.1 + 0.9 * awake; }

}  // namespace

bool HasJoints(const Scene& scene) {
  return std::any_of(scene.joints.begin(), scene.joints.end(), [&](const Joint& joint) {
    return !joint.gone && !IsRigid(joint, scene.solver) &&
           HoldOf(joint.kind) != JointHold::kImposed;
  });
}

double CaseBudget(GridSize size) {
  switch (size) {
    case GridSize::kQuick: return 2;
    case GridSize::kReport: return 20;
    case GridSize::kFull: break;
  }
  return 50000;
}

double AwakeShare(const HardCase& hard, GridSize size, const std::string& folder) {
  const Scene scene = WithSolver(LoadHardScene(hard, folder), StockSolver());
  const bool left_out = PredictedCpu(scene, scene.solver, hard.seconds) > CaseBudget(size);
  if (size == GridSize::kQuick && left_out) return 1;
  World world(scene);
  ScriptPlayer hand(scene);
  const std::int64_t ticks = std::llround(hard.seconds * scene.solver.tick_hz);
  std::int64_t awake = 0;
  while (world.tick() < ticks) {
    hand.Play(scene, world.tick() + 1, &world);
    world.Step();
    for (int body = 0; body < world.body_count(); ++body) awake += world.awake(body) ? 1 : 0;
  }
  return static_cast<double>(awake) / static_cast<double>(ticks * std::max(1, world.body_count()));
}

PhysicsPlan PlanPhysics(const std::vector<const HardCase*>& cases, GridSize size,
                        const std::vector<double>& awake, const std::string& folder) {
  PhysicsPlan plan;
  const double budget = CaseBudget(size);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const HardCase* const hard = cases[i];
    const Scene scene = LoadHardScene(*hard, folder);
    const double share = SleptThrough(awake[i]);
    const double sleepless = PredictedCpu(scene, StockSolver(), hard->seconds);
    const double stock_cost = share * sleepless;
    if (size == GridSize::kQuick && sleepless > budget) {
      plan.left_out.push_back(fmt::format("{}: left out: its stock run may take {:.0f} s of CPU",
                                          hard->name, sleepless));
      continue;
    }
    plan.points.push_back({hard, "stock", WithSolver(scene, StockSolver())});
    plan.points.push_back({hard, "scene", scene});
    double spent = 0;
    int tried = 0, left_out = 0;
    for (const Solver& solver : GridSettings(size, scene.solver)) {
      if (SameSolver(solver, scene.solver) || SameSolver(solver, StockSolver())) continue;
      const double own = share * PredictedCpu(scene, solver, hard->seconds);
      if (spent + RowCost(own, stock_cost) > budget) {
        ++left_out;
        continue;
      }
      spent += RowCost(own, stock_cost);
      ++tried;
      plan.points.push_back({hard, "grid", WithSolver(scene, solver)});
    }
    AddJointPoints(hard, scene, &plan);
    AddSoftPoints(hard, scene, &plan);
    if (left_out > 0) {
      plan.left_out.push_back(
          fmt::format("{}: {} of {} settings of the grid left out: over {:.0f} s of CPU",
                      hard->name, left_out, tried + left_out, budget));
    }
  }
  return plan;
}

}  // namespace seam
