#include "tests/lab/hard/physics_plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace seam {
namespace {

/// CPU seconds of a row: the run that is observed, and those of both settings that are timed.
double RowCost(double own, double stock) {
  return own + std::max(own + stock, std::min(0.15, 15 * (own + stock)));
}

}  // namespace

double CaseBudget(GridSize size) {
  switch (size) {
    case GridSize::kQuick: return 2;
    case GridSize::kReport: return 15;
    case GridSize::kFull: break;
  }
  return 50000;
}

PhysicsPlan PlanPhysics(const std::vector<const HardCase*>& cases, GridSize size,
                        const std::string& folder) {
  PhysicsPlan plan;
  const double budget = CaseBudget(size);
  for (const HardCase* hard : cases) {
    const Scene scene = LoadHardScene(*hard, folder);
    const double stock_cost = PredictedCpu(scene, StockSolver(), hard->seconds);
    if (size == GridSize::kQuick && stock_cost > budget) {
      plan.left_out.push_back(fmt::format("{}: left out: its stock run may take {:.0f} s of CPU",
                                          hard->name, stock_cost));
      continue;
    }
    plan.points.push_back({hard, "stock", WithSolver(scene, StockSolver())});
    plan.points.push_back({hard, "scene", scene});
    double spent = 0;
    int tried = 0, left_out = 0;
    for (const Solver& solver : GridSettings(size, scene.solver)) {
      if (SameSolver(solver, scene.solver) || SameSolver(solver, StockSolver())) continue;
      const double own = PredictedCpu(scene, solver, hard->seconds);
      if (spent + RowCost(own, stock_cost) > budget) {
        ++left_out;
        continue;
      }
      spent += RowCost(own, stock_cost);
      ++tried;
      plan.points.push_back({hard, "grid", WithSolver(scene, solver)});
    }
    if (left_out > 0) {
      plan.left_out.push_back(
          fmt::format("{}: {} of {} settings of the grid left out: over {:.0f} s of CPU",
                      hard->name, left_out, tried + left_out, budget));
    }
  }
  return plan;
}

}  // namespace seam
