#include "tests/lab/report/validity.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "tests/lab/report/files.h"

namespace seam {

namespace fs = std::filesystem;

Validity FindValidity(const CsvTable& table, const std::vector<std::size_t>& rows) {
  Validity validity;
  for (const std::size_t row : rows) {
    ++validity.rows;
    const std::string& reason = table.Text(row, "valid");
    if (reason.empty()) continue;
    if (validity.invalid++ == 0) validity.reason = reason;
  }
  return validity;
}

Validity FindValidity(const CsvTable& table) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) rows.push_back(row);
  return FindValidity(table, rows);
}

std::string WithValidity(const std::string& value, const Validity& validity) {
  if (validity.none()) return "not valid: " + validity.reason;
  if (validity.invalid == 0) return value;
  return fmt::format("{} ({} of {} not valid)", value, validity.invalid, validity.rows);
}

std::vector<std::string> TablesNotValid(const std::string& data) {
  std::vector<std::string> lines;
  for (const fs::path& folder :
       {fs::path(data), fs::path(data) / "world", fs::path(data) / "relief"}) {
    std::error_code none;  // a folder that is not there has no tables
    for (const fs::path& path : FilesIn(folder, ".csv", &none)) {
      const Validity validity = FindValidity(CsvTable::Load(path.string()));
      if (!validity.too_many()) continue;
      lines.push_back(fmt::format("{}: {} of {} rows are not valid, the first: {}", path.string(),
                                  validity.invalid, validity.rows, validity.reason));
    }
  }
  return lines;
}

}  // namespace seam
