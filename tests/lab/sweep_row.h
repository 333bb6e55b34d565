#pragma once
/// One row of a sweep's table: the settings of a run, and its measures.

#include <string>

#include "tests/lab/experiment/values.h"
#include "tests/lab/grid.h"

namespace seam {

/// Optional parts of a row beside the measures; each costs oracle runs.
struct SweepOptions {
  bool floor = true;   ///< error by chaos alone
  bool limit = false;  ///< error of held inputs
};

/// Names of the key's columns (GridKey) and of the values', with commas between.
std::string SweepKeyColumns();
std::string SweepValueColumns();

/// Runs and measures. Returns the point's numbers, the measures of docs/metrics.md, the oracle that
/// judged them, whether they are valid, digest and CPU times. Everything but the last three, CPU
/// times, depends on the point alone. The measures are empty when they are not valid. Throws
/// OperatorError when nobody can join.
Values SweepValues(const GridPoint& point, const SweepOptions& options);

}  // namespace seam
