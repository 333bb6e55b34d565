#pragma once
/// Named values: one list gives both the header of a table and the text below each column.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seam {

struct Value {
  std::string column;
  std::string text;  ///< empty: does not apply
};
using Values = std::vector<Value>;

/// Returns a value with this many digits behind the point.
Value Decimals(const char* column, double value, int digits);
/// Returns a value with this many significant digits; an absent one is empty.
Value Significant(const char* column, std::optional<double> value, int digits = 6);
/// Returns a count.
Value Count(const char* column, std::int64_t count);

/// Returns the texts as a CSV line without its end; quotes those that need it.
std::string CsvRow(const std::vector<std::string>& texts);
std::string CsvRow(const Values& values);
/// Returns the names of the columns, in the same form.
std::string CsvColumns(const Values& values);

/// Puts the column "valid" first, which holds `reason`. With a reason the others become empty.
Values Judged(const std::string& reason, const Values& values);
/// Returns the same columns without texts.
Values Emptied(Values values);

}  // namespace seam
