#include "tests/lab/experiment/result_table.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/base/files_read.h"
#include "common/base/plain_file.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/experiment/key_index.h"
#include "tests/lab/experiment/values.h"

namespace seam {
namespace {

using Fields = std::vector<std::string>;

/// Empty for a damaged line.
Fields FieldsOr(const std::string& line) {
  try {
    return CsvFields(line);
  } catch (const OperatorError&) {
    return {};
  }
}

[[noreturn]] void RefuseTable(const std::string& path, const std::string& why) {
  throw OperatorError(path + ": " + why + "; choose another name, or --force to begin anew");
}

[[noreturn]] void CannotWrite(const std::string& path) {
  throw OperatorError(path + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

ResultTable::ResultTable(const std::string& path, const std::string& key_columns,
                         const std::string& value_columns, const std::vector<std::string>& keys,
                         bool force)
    : path_(path),
      header_(key_columns + ',' + value_columns),
      lock_((RequirePlainFile(path), path)),
      lines_(keys.size()) {
  const bool there = access(path.c_str(), F_OK) == 0;
  if (WasFileRead(path)) throw OperatorError(path + ": is read, it cannot be written");
  Load(there && !force ? ReadPlainFile(path, kTableBytesMax) : "", CsvFields(key_columns), keys);
  Rewrite();
}

ResultTable::~ResultTable() {
  if (file_ != nullptr) std::fclose(file_);
}

void ResultTable::Load(const std::string& text, const std::vector<std::string>& key_columns,
                       const std::vector<std::string>& keys) {
  KeyIndex rows(key_columns);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (rows.Add(CsvFields(keys[i]), i)) continue;
    throw OperatorError(path_ + ": the same run twice: " + keys[i]);
  }
  const std::size_t columns = CsvFields(header_).size();
  std::size_t at = text.find('\n');
  const std::string first = text.substr(0, at);
  if (at == std::string::npos ? header_.rfind(first, 0) != 0 : first != header_) {
    RefuseTable(path_, "is not a sweep's table of this program");
  }
  for (int number = 2; at != std::string::npos; ++number) {
    const std::size_t begin = at + 1;
    at = text.find('\n', begin);
    if (at == std::string::npos) break;  // half-written, or the end
    const std::string line = text.substr(begin, at - begin);
    const Fields fields = FieldsOr(line);
    const auto values =
        fields.begin() + static_cast<std::ptrdiff_t>(std::min(key_columns.size(), fields.size()));
    const Fields key(fields.begin(), values);
    const auto row = fields.size() == columns ? rows.Find(key) : std::nullopt;
    if (!row || Has(*row)) {
      RefuseTable(path_, "line " + std::to_string(number) +
                             " is not of this sweep (scene, settings or version differ)");
    }
    const bool same = CsvFields(keys[*row]) == key;  // else its scene lay in another folder
    lines_[*row] = same ? line : keys[*row] + ',' + CsvRow(Fields(values, fields.end()));
    ++count_;
  }
}

void ResultTable::Rewrite() {
  if (file_ != nullptr) std::fclose(file_);
  file_ = nullptr;
  ordered_ = true;
  const std::string draft = path_ + ".part";
  std::string text = header_ + '\n';
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!Has(i)) continue;
    text += lines_[i] + '\n';
    end_ = i + 1;
  }
  std::FILE* file = OpenPlainFile(draft, FileUse::kReplace);
  if (file == nullptr) CannotWrite(path_);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed || std::rename(draft.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    std::remove(draft.c_str());
    errno = error;
    CannotWrite(path_);
  }
  file_ = OpenPlainFile(path_, FileUse::kAppend);
  if (file_ == nullptr) CannotWrite(path_);
}

void ResultTable::Add(std::size_t row, const std::string& line) {
  SEAM_ASSERT(!Has(row));
  lines_[row] = line;
  ++count_;
  ordered_ = ordered_ && row >= end_;
  end_ = row + 1;
  const std::string text = line + '\n';
  const bool written = std::fwrite(text.data(), 1, text.size(), file_) == text.size();
  if (std::fflush(file_) != 0 || !written) CannotWrite(path_);
  if (count_ == lines_.size() && !ordered_) Rewrite();
}

}  // namespace seam
