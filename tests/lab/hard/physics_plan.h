#pragma once
/// Chooses the settings to try on each hard case, within a bounded cost.

#include <string>
#include <vector>

#include "tests/lab/hard/hard_case.h"
#include "tests/lab/hard/settings.h"

namespace seam {

/// One run: a case with one setting.
struct PhysicsPoint {
  const HardCase* hard = nullptr;
  std::string role;  ///< stock | scene | grid | iterative | exact
  Scene scene;       ///< with the setting in `solver`
};

struct PhysicsPlan {
  /// By case; in each the stock setting, the scene's, the grid, and where it has joints the scene's
  /// with iterative joints (unless they are that) and with exact ones.
  std::vector<PhysicsPoint> points;
  std::vector<std::string> left_out;  ///< settings of the grid that cost too much, a line each
};

/// True if the engine has joints in the scene.
bool HasJoints(const Scene& scene);

/// CPU seconds for a case's grid; what exceeds it is left out. The stock and the scene's setting
/// are always there, but in kQuick, which leaves out cases whose stock run is predicted to take
/// more when nothing sleeps.
double CaseBudget(GridSize size);

/// The share of its bodies' ticks that the case's stock run is awake, 0..1: what its cost and that
/// of other settings is predicted with, counted and not timed, so that every machine plans the same
/// table. 1 where kQuick leaves it out.
double AwakeShare(const HardCase& hard, GridSize size, const std::string& folder);

/// `awake`: of each case. `cases` must outlive the plan. `folder`: of the scenes. Throws
/// OperatorError.
PhysicsPlan PlanPhysics(const std::vector<const HardCase*>& cases, GridSize size,
                        const std::vector<double>& awake, const std::string& folder);

}  // namespace seam
