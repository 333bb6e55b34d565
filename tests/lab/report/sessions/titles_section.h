#pragma once
/// The report's section on `seam-lab titles`: the number of sessions in which a scene kept the
/// promise of its title.

#include <string>

#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/page.h"

namespace seam {

/// Returns a row for each scene, a column for each network ("9 of 10"), and the first miss. Throws
/// OperatorError when it is another kind of table.
TextTable TitlesTable(const CsvTable& csv, const std::string& command);
Section TitlesSection(const CsvTable& csv, const std::string& command);

}  // namespace seam
