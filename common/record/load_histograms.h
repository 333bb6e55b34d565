#pragma once
/// The histograms in a server's page: how long its ticks took and how late they began, since its
/// beginning.

#include <string>

#include "common/record/load_page.h"

namespace seam {

/// Heads and samples of all rooms, in the exposition format.
std::string WriteHistograms(const std::vector<RoomLoad>& loads);

/// Takes up the sample `name{...} value` if it is of a histogram; `le`: its label of that name, ""
/// if it has none.
void TakeHistogram(const std::string& name, const std::string& le, double value, RoomLoad* room);

}  // namespace seam
