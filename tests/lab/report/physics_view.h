#pragma once
/// The table of `seam-lab physics` by hard case: stock's setting, the scene's own, and all others.

#include <optional>
#include <string>
#include <vector>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/statistics.h"

namespace seam {

struct PhysicsRun {
  std::size_t row = 0;  ///< of the table
  std::string setting;  ///< "120 Hz, 4/1 × 2, skin 0.0025 m"
  double tick_hz = 60;
  bool warm = true;
  std::string role;                  ///< stock | scene | grid | iterative | exact
  std::string joints = "iterative";  ///< auto | exact | iterative
  int joint_substeps = 1, contact_substeps = 1;
  std::string levers;  ///< the setting without what is the scene's: "60 Hz, 8/3 × 2, cold"
  double error = 0;  ///< in the case's unit; infinite: diverged
  double penetration_m = 0, joint_drift_m = 0;
  double cost_ratio = 1;  ///< of CPU time to stock's beside it; NaN: it crashed
  std::string failure;    ///< what happened that must not; "": nothing
  bool held() const { return failure.empty(); }
};

struct PhysicsCase {
  std::string name, truth, unit;
  std::optional<PhysicsRun> stock, scene;
  std::vector<PhysicsRun> all;  ///< these two included, in the order of the table
};

/// Throws OperatorError for a table that is not of `seam-lab physics`.
std::vector<PhysicsCase> ViewPhysics(const CsvTable& table);

/// Error and cost of runs; a failed one has an infinite error, whatever was measured of it.
std::vector<CostError> PhysicsTrials(const std::vector<PhysicsRun>& runs);

/// `a`'s error to `b`'s: 1 when both are 0 or both failed; 0 when only `b` failed; infinite when
/// only `a` did.
double ErrorRatio(const PhysicsRun& a, const PhysicsRun& b);

/// The cheapest run that holds and is no worse than stock; nullptr: none.
const PhysicsRun* CheapestNoWorse(const PhysicsCase& c);
/// The best run that holds at no more than 1.1 times stock's cost; nullptr: none.
const PhysicsRun* BestAtStocksCost(const PhysicsCase& c);

/// What the scene's own setting achieves, in words: "no worse, cheaper", ...
std::string Verdict(const PhysicsCase& c);

}  // namespace seam
