#pragma once
/// What a user's own scene gets said beyond the table: how it is judged, and the front of error
/// against cost.

#include <string>
#include <vector>

#include "tests/lab/hard/hard_case.h"

namespace seam {

/// One line for each case: its name, seconds, and what the error is.
std::string CaseLines(const std::vector<HardCase>& cases);

/// Of each case in the CSV table at `path` the settings that no other beats, by rising cost, as
/// lines to be printed. Throws OperatorError for a table that is not of `seam-lab physics`.
std::string FrontLines(const std::string& path);

}  // namespace seam
