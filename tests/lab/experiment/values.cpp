#include "tests/lab/experiment/values.h"

#include <fmt/format.h>

#include "common/measure/table.h"

namespace seam {

Value Decimals(const char* column, double value, int digits) {
  return {column, fmt::format("{:.{}f}", value, digits)};
}

Value Significant(const char* column, std::optional<double> value, int digits) {
  return {column, value ? fmt::format("{:.{}g}", *value, digits) : ""};
}

Value Count(const char* column, std::int64_t count) { return {column, std::to_string(count)}; }

std::string CsvRow(const std::vector<std::string>& texts) {
  std::string line;
  for (std::size_t i = 0; i < texts.size(); ++i) line += (i > 0 ? "," : "") + CsvField(texts[i]);
  return line;
}

std::string CsvRow(const Values& values) {
  std::vector<std::string> texts;
  for (const Value& value : values) texts.push_back(value.text);
  return CsvRow(texts);
}

std::string CsvColumns(const Values& values) {
  std::vector<std::string> columns;
  for (const Value& value : values) columns.push_back(value.column);
  return CsvRow(columns);
}

Values Judged(const std::string& reason, const Values& values) {
  const Values shown = reason.empty() ? values : Emptied(values);
  Values judged = {{"valid", reason}};
  judged.insert(judged.end(), shown.begin(), shown.end());
  return judged;
}

Values Emptied(Values values) {
  for (Value& value : values) value.text.clear();
  return values;
}

}  // namespace seam
