#pragma once
/// Measures for people at a terminal: measures downwards, runs across, in units of daily life.

#include <string>
#include <vector>

#include "common/measure/table.h"

namespace seam {

/// Formats the runs as a table of at most `width` characters a line, in several blocks if needed;
/// one column is never cut. The best of several values has a star. With `medians`, the valid runs
/// of one setting (scene, method, network) share a column of nearest-rank medians. Runs that are
/// not valid have no figures, and a line with the reason and the remedy below the table; so have
/// runs whose logs lack something.
std::string FormatReadable(const std::vector<MeasuredRun>& runs, std::size_t width, bool medians);

}  // namespace seam
