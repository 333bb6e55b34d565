#pragma once
/// One line of the table of `seam-lab physics`.

#include <map>
#include <string>

#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/physics_plan.h"

namespace seam {

constexpr int kPhysicsKeyColumns = 16;
std::string PhysicsHeader();

/// Returns the first kPhysicsKeyColumns values: the row's key. `version` holds a hash of the
/// scene's text.
std::string PhysicsKey(const PhysicsPoint& point);

/// Runs and measures; the line without its end. All but the last columns cpu_us_per_s,
/// stock_cpu_us_per_s and cost_ratio is a function of the point. `reference`: where the case has no
/// judge; if it is not converged, that is the row's failure.
std::string PhysicsRow(const PhysicsPoint& point, const Reference* reference);

/// Returns the line of a run that crashed its process.
std::string CrashedRow(const PhysicsPoint& point, const std::string& why);

/// Prints per case: the error of the stock and of the scene's own setting, their ratio, the ratio
/// of their costs, and failures. `lines`: the existing rows, by point; empty: not yet.
void PrintPhysics(const PhysicsPlan& plan, const std::vector<std::string>& lines);

}  // namespace seam
