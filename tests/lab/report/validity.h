#pragma once
/// Rows whose precondition did not hold: how a table says so, and when there are too many of them.
/// A row is not valid where its column `valid` says why; its figures are empty.

#include <string>
#include <vector>

#include "tests/lab/report/csv_table.h"

namespace seam {

struct Validity {
  std::size_t rows = 0, invalid = 0;
  std::string reason;  ///< of the first that is not valid
  bool none() const { return rows > 0 && invalid == rows; }
};

/// Of some rows of a table; all are valid where the table has no such column.
Validity FindValidity(const CsvTable& table, const std::vector<std::size_t>& rows);
/// Of all rows.
Validity FindValidity(const CsvTable& table);

/// `value`, the median of what is valid: "not valid: REASON" where nothing is, with " (2 of 8 not
/// valid)" behind it where some is not.
std::string WithValidity(const std::string& value, const Validity& validity);

/// A line for each CSV file of the report's data, those of world and relief included, of which more
/// than a tenth of the rows is not valid: "PATH: 12 of 40 rows are not valid, the first: REASON".
/// Throws OperatorError for a file that is damaged.
std::vector<std::string> TablesNotValid(const std::string& data);

}  // namespace seam
