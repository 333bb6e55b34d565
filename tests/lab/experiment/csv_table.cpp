#include "tests/lab/experiment/csv_table.h"

#include <fmt/format.h>

#include <cstdlib>

#include "common/base/check.h"
#include "common/base/plain_file.h"

namespace seam {
namespace {

[[noreturn]] void Fail(const std::string& path, int line, const std::string& why) {
  throw OperatorError(fmt::format("{}:{}: {}", path, line, why));
}

/// Takes a text apart, record by record.
class Reader {
 public:
  Reader(const std::string& text, const std::string& path) : text_(text), path_(path) {}

  bool done() const { return at_ == text_.size(); }
  int line() const { return line_; }  ///< at which the next record begins

  std::vector<std::string> Record() {
    const int begin = line_;
    std::vector<std::string> fields(1);
    while (!done()) {
      const char c = text_[at_++];
      if (c == '"' && fields.back().empty()) {
        fields.back() = Quoted(begin);
      } else if (c == ',') {
        fields.emplace_back();
      } else if (c == '\n') {
        ++line_;
        return fields;
      } else if (c != '\r' || done() || text_[at_] != '\n') {
        fields.back() += c;
      }
    }
    Fail(path_, begin, "the line has no end: its writer was interrupted, or still writes");
  }

 private:
  /// After its first quote.
  std::string Quoted(int begin) {
    std::string field;
    while (!done()) {
      const char c = text_[at_++];
      if (c == '\n') ++line_;
      if (c == '"') {
        if (done() || text_[at_] != '"') return field;
        ++at_;
      }
      field += c;
    }
    Fail(path_, begin, "a quote does not close");
  }

  const std::string& text_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<std::string> CsvFields(const std::string& line) {
  const std::string text = line + '\n', path = "a CSV line";
  Reader reader(text, path);
  std::vector<std::string> fields = reader.Record();
  if (!reader.done()) Fail(path, reader.line(), "there is a second line");
  return fields;
}

CsvTable CsvTable::Load(const std::string& path) {
  return Parse(ReadPlainFile(path, kTableBytesMax), path);
}

CsvTable CsvTable::Parse(const std::string& text, const std::string& path) {
  CsvTable table;
  table.path_ = path;
  Reader reader(text, path);
  if (reader.done()) throw OperatorError(path + ": is empty");
  table.header_ = reader.Record();
  for (std::size_t i = 0; i < table.header_.size(); ++i) {
    if (!table.columns_.emplace(table.header_[i], i).second) {
      Fail(path, 1, "the column " + table.header_[i] + " is there twice");
    }
  }
  while (!reader.done()) {
    const int line = reader.line();
    std::vector<std::string> fields = reader.Record();
    if (fields.size() != table.header_.size()) {
      Fail(path, line,
           fmt::format("{} fields, but the header has {}", fields.size(), table.header_.size()));
    }
    table.rows_.push_back(std::move(fields));
    table.lines_.push_back(line);
  }
  return table;
}

const std::string& CsvTable::Text(std::size_t row, const std::string& column) const {
  static const std::string none;
  const auto found = columns_.find(column);
  return found == columns_.end() ? none : rows_.at(row)[found->second];
}

std::optional<double> CsvTable::Number(std::size_t row, const std::string& column) const {
  const std::string& text = Text(row, column);
  if (text.empty()) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end != '\0') {
    Fail(path_, lines_.at(row), fmt::format("{} is not a number: {}", column, text));
  }
  return value;
}

void CsvTable::Require(const std::vector<std::string>& columns) const {
  for (const std::string& column : columns) {
    if (!Has(column)) Fail(path_, 1, "has no column " + column);
  }
}

}  // namespace seam
