#pragma once
/// Output for a user's own scene besides the table: its judge, and the front of error against cost.

#include <string>
#include <vector>

#include "tests/lab/hard/hard_case.h"

namespace seam {

/// One line for each case: its name, seconds, and the meaning of its error.
std::string CaseLines(const std::vector<HardCase>& cases);

/// Returns, as lines to print, the settings of each case in the CSV table at `path` that no other
/// beats, by rising cost. Throws OperatorError for a table that is not of `seam-lab physics`.
std::string FrontLines(const std::string& path);

}  // namespace seam
