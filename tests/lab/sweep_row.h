#pragma once
/// One line of a sweep's table: the settings of a run, and its measures.

#include <string>

#include "tests/lab/grid.h"

namespace seam {

/// Optional parts of a row beside the measures; each costs oracle runs.
struct SweepOptions {
  bool floor = true;   ///< error by chaos alone
  bool limit = false;  ///< information limit
};

/// The grid's columns, the same in numbers, then the measures of docs/metrics.md, by which oracle,
/// whether they are valid, digest and CPU times.
std::string SweepHeader();

/// Runs and measures; returns the line without its end. Everything but the last three columns, CPU
/// times, depends on the point alone. A row that is not valid has no figures. Throws OperatorError
/// if no client can join.
std::string SweepRow(const GridPoint& point, const SweepOptions& options);

}  // namespace seam
