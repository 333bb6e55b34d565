#pragma once
/// Rows whose precondition did not hold: counts them, marks them in tables, and reports files with
/// too many of them. A row is invalid if its column `valid` holds a reason; its figures are empty.

#include <string>
#include <vector>

#include "tests/lab/experiment/csv_table.h"

namespace seam {

struct Validity {
  std::size_t rows = 0, invalid = 0;
  std::string reason;  ///< of the first invalid row
  bool none() const { return rows > 0 && invalid == rows; }
  /// True if more than a tenth are invalid: medians of the rest would mean little.
  bool too_many() const { return 10 * invalid > rows; }
};

/// Counts among some rows of a table; all are valid where the table has no such column.
Validity FindValidity(const CsvTable& table, const std::vector<std::size_t>& rows);
/// Counts among all rows.
Validity FindValidity(const CsvTable& table);

/// Returns `value`, the median of the valid rows, with " (2 of 8 not valid)" behind it where some
/// are not; "not valid: REASON" where none is.
std::string WithValidity(const std::string& value, const Validity& validity);

/// Returns a line for each CSV file of the report's data, those of world and relief included, of
/// which more than a tenth of the rows are not valid: "PATH: 12 of 40 rows are not valid, the
/// first: REASON". Throws OperatorError for a file that is damaged.
std::vector<std::string> TablesNotValid(const std::string& data);

}  // namespace seam
