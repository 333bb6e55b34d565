#pragma once
/// What the report shows of `seam-lab titles`: in how many sessions a scene did what its title
/// says.

#include <string>

#include "tests/lab/report/csv_table.h"
#include "tests/lab/report/page.h"

namespace seam {

/// A row for each scene, a column for each network: "9 of 10", and what was missed first. Throws
/// OperatorError when it is another kind of table.
TextTable TitlesTable(const CsvTable& csv, const std::string& command);
Section TitlesSection(const CsvTable& csv, const std::string& command);

}  // namespace seam
