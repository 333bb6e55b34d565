#pragma once
/// A session's sum as a table for the terminal, and as JSON.

#include <string>
#include <vector>

#include "common/codec/summary.h"

namespace seam {

/// Returns the names of the sum's clients; "" for those that the message lacks.
std::vector<std::string> NamesOf(const Summary& summary);
/// Returns a line about the session, and if there were clients a line with column names and one for
/// each. Each line ends with a line end.
std::string SummaryTable(const Summary& summary, int tick_hz);
/// Returns a JSON object, for JSON Lines on one line. `room` and `scene`: names.
std::string SummaryJson(const Summary& summary, const std::string& room, const std::string& scene,
                        int tick_hz);

}  // namespace seam
