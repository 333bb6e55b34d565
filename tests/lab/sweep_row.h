#pragma once
/// One line of a sweep's table: what a run was, and what was measured of it.

#include <string>

#include "tests/lab/grid.h"

namespace seam {

/// The grid's columns, the same in numbers, then the measures of docs/metrics.md, digest and cpu_s.
std::string SweepHeader();

/// Runs and measures; the line without its end. Everything but the last column, cpu_s, depends on
/// the point alone. Throws OperatorError when nobody can join.
std::string SweepRow(const GridPoint& point, bool floor);

}  // namespace seam
