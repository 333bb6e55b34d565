#pragma once
/// The report's section on `seam-lab fairness`: the momentum that each player receives in a
/// mirrored crash.

#include <string>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/page.h"

namespace seam {

/// Returns a row for each method, in the order of the table, of the runs with that `drive`:
/// "script" or "random". Throws OperatorError when it is another kind of table.
TextTable FairnessTable(const CsvTable& csv, const std::string& drive, const std::string& command);
Section FairnessSection(const CsvTable& csv, const std::string& command);

}  // namespace seam
