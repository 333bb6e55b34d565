#pragma once
/// One line of a sweep's table: what a run was, and what was measured of it.

#include <string>

#include "tests/lab/grid.h"

namespace seam {

/// What a row has beside the measures; each costs oracles.
struct SweepOptions {
  bool floor = true;   ///< what chaos alone does
  bool limit = false;  ///< what nobody could know
};

/// The grid's columns, the same in numbers, then the measures of docs/metrics.md, by which oracle,
/// whether they are valid, digest and CPU times.
std::string SweepHeader();

/// Runs and measures; the line without its end. Everything but the last three columns, CPU times,
/// depends on the point alone. A row that is not valid has no figures. Throws OperatorError when
/// nobody can join.
std::string SweepRow(const GridPoint& point, const SweepOptions& options);

}  // namespace seam
