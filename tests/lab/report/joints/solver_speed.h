#pragma once
/// Speed against error of the solver: each setting of the hard cases as one dot, over all cases on
/// which it was tried.

#include <string>
#include <vector>

#include "tests/lab/report/page.h"
#include "tests/lab/report/physics_view.h"

namespace seam {

/// A setting over several cases; ratios are to stock's on the same case.
struct SolverSetting {
  std::string kind;  ///< "engine", "engine, thin skin", "exact joints", "soft contacts", ...
  std::string name;  ///< "60 Hz, 8/3 × 2", "exact × 1"
  std::vector<double> errors, costs;  ///< of the cases; an error is infinite where it alone fails
  int failed = 0;                     ///< cases
};

/// Returns the settings that were tried on at least half of the cases that have joints (or of those
/// that have none), stock and the scenes' own included.
std::vector<SolverSetting> SolverSettings(const std::vector<PhysicsCase>& cases, bool jointed);

/// Returns a figure of medians, cases with joints and without them beside each other, and a table
/// of the same numbers.
Figure SolverSpeed(const std::vector<PhysicsCase>& cases, const std::string& command);
TextTable SolverSpeedTable(const std::vector<PhysicsCase>& cases, const std::string& command);

}  // namespace seam
