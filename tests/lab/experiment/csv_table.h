#pragma once
/// Reads CSV (RFC 4180): a line, or a file with a header, its columns found by name. Damage is
/// reported once.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seam {

/// Returns the values of a CSV line without its end. Throws OperatorError for a quote that does not
/// close, or more than one line.
std::vector<std::string> CsvFields(const std::string& line);

class CsvTable {
 public:
  /// Throws OperatorError, "path:line: ...", for a file that cannot be read, a quote that does not
  /// close, a line with another number of fields than the header, or one without its end (of a
  /// writer that was interrupted).
  static CsvTable Load(const std::string& path);
  static CsvTable Parse(const std::string& text, const std::string& path);

  std::size_t rows() const { return rows_.size(); }
  bool Has(const std::string& column) const { return columns_.count(column) > 0; }
  const std::vector<std::string>& header() const { return header_; }
  const std::string& path() const { return path_; }

  /// "" where there is no such column.
  const std::string& Text(std::size_t row, const std::string& column) const;
  /// Nothing where the field is empty or there is no such column; inf and nan are numbers. Throws
  /// OperatorError when it is anything else.
  std::optional<double> Number(std::size_t row, const std::string& column) const;
  /// Throws OperatorError naming the first of `columns` that is missing.
  void Require(const std::vector<std::string>& columns) const;

 private:
  std::string path_;
  std::vector<std::string> header_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<int> lines_;  // in the file, of each row
};

}  // namespace seam
