#pragma once
/// The report's curves of the methods' error around one event, laid over each other.

#include <string>

#include "tests/lab/report/page.h"

namespace seam {

/// Returns a figure for each table of `folder` that `seam-measure --around-csv` has written, by
/// scene; empty without any. Throws OperatorError for another table.
Section AroundSection(const std::string& folder);

}  // namespace seam
