#pragma once
/// One row of the table of `seam-lab physics`.

#include <string>
#include <vector>

#include "tests/lab/experiment/values.h"
#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/physics_plan.h"

namespace seam {

/// Returns the key of a row. `version` holds a hash of the scene's text.
Values PhysicsKey(const PhysicsPoint& point);

/// Runs and measures. All but the last columns cpu_us_per_s, stock_cpu_us_per_s and cost_ratio is a
/// function of the point. `reference`: where the case has no judge; if it is not converged, that is
/// the row's failure.
Values PhysicsValues(const PhysicsPoint& point, const Reference* reference);

/// Returns the values of a run that took its process with it.
Values CrashedValues(const std::string& why);

/// Names of the key's columns and of the values', with commas between.
std::string PhysicsKeyColumns();
std::string PhysicsValueColumns();

/// Prints of each case the error of the stock and of the scene's own setting, the ratios of their
/// errors and costs, and failures. `lines`: the rows there are, by point; empty: not yet.
void PrintPhysics(const PhysicsPlan& plan, const std::vector<std::string>& lines);

}  // namespace seam
