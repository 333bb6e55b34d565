#pragma once
/// Which settings are tried on which hard case, within a bounded cost.

#include <string>
#include <vector>

#include "tests/lab/hard/hard_case.h"
#include "tests/lab/hard/settings.h"

namespace seam {

/// One run: a case with one setting.
struct PhysicsPoint {
  const HardCase* hard = nullptr;
  std::string role;                   ///< stock | scene | grid
  Scene scene;                        ///< with the setting in `solver`
};

struct PhysicsPlan {
  std::vector<PhysicsPoint> points;   ///< by case; in each the stock setting, the scene's, the grid
  std::vector<std::string> left_out;  ///< what of the grid was too dear, a line each
};

/// CPU seconds for a case's grid, by PredictedCpu; what exceeds it is left out. Predicted, not
/// measured, so that every machine plans the same table. The stock and the scene's setting are
/// always there, but in kQuick, which leaves out cases whose stock run is predicted to take more.
double CaseBudget(GridSize size);

/// `cases` must outlive the plan. `folder`: of the scenes. Throws OperatorError.
PhysicsPlan PlanPhysics(const std::vector<const HardCase*>& cases, GridSize size,
                        const std::string& folder);

}  // namespace seam
