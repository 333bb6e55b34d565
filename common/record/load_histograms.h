#pragma once
/// The histograms in a server's page: durations and lateness of all ticks since its start.

#include <string>

#include "common/record/load_page.h"

namespace seam {

/// Returns a number of the exposition format, to 15 digits.
std::string MetricNumber(double value);

/// Returns headers and samples of all rooms in the exposition format.
std::string WriteHistograms(const std::vector<RoomLoad>& loads);

/// Stores the sample `name{...} value` in `room` if it belongs to a histogram. `le` is the value of
/// its label le, "" if there is none.
void TakeHistogram(const std::string& name, const std::string& le, double value, RoomLoad* room);

}  // namespace seam
