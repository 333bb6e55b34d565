#pragma once
/// What the report shows of `seam-lab fairness`: who receives how much of a mirrored crash.

#include <cstddef>
#include <string>

#include "tests/lab/report/csv_table.h"
#include "tests/lab/report/page.h"

namespace seam {

/// A row for each method, in the order of the table, of the runs with that `drive`: "script" or
/// "random". Throws OperatorError when it is another kind of table.
TextTable FairnessTable(const CsvTable& csv, const std::string& drive, const std::string& command);
Section FairnessSection(const CsvTable& csv, const std::string& command);

/// Rows that say in their column `valid` why they have no figures.
std::size_t InvalidRows(const CsvTable& csv);

}  // namespace seam
