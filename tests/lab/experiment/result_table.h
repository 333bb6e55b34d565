#pragma once
/// The CSV file of an experiment. It holds complete lines at any moment, whenever the program is
/// killed: in the order in which they came, and of the rows once it is loaded again or has all.

#include <cstdio>
#include <string>
#include <vector>

#include "tests/lab/experiment/table_lock.h"

namespace seam {

class ResultTable {
 public:
  /// Takes over the rows that an earlier run left in `path`; drops a last line without its end.
  /// `key_columns` and `value_columns` are names with commas between, `keys` the texts of all rows'
  /// key columns as CSV; a row counts as KeyIndex finds it. Throws OperatorError when two keys are
  /// equal, when the file has other columns or rows, unless `force` (then it begins anew), when it
  /// cannot be written, when this program has read it as a scene or the like, or when another
  /// process writes it.
  ResultTable(const std::string& path, const std::string& key_columns,
              const std::string& value_columns, const std::vector<std::string>& keys, bool force);
  ~ResultTable();
  ResultTable(const ResultTable&) = delete;
  ResultTable& operator=(const ResultTable&) = delete;

  bool Has(std::size_t row) const { return !lines_[row].empty(); }
  /// Returns the row's line; empty when it is not there yet.
  const std::string& line(std::size_t row) const { return lines_[row]; }
  std::size_t count() const { return count_; }
  /// Adds `line`, without its end, which begins with the row's key. Throws OperatorError when the
  /// disk is full.
  void Add(std::size_t row, const std::string& line);

 private:
  void Load(const std::string& text, const std::vector<std::string>& key_columns,
            const std::vector<std::string>& keys);
  void Rewrite();

  std::string path_, header_;
  TableLock lock_;
  std::vector<std::string> lines_;  // by row; empty: not there yet
  std::size_t count_ = 0;
  std::size_t end_ = 0;        // one behind the last row in the file
  bool ordered_ = true;        // the file has its rows in their order
  std::FILE* file_ = nullptr;  // open to append
};

}  // namespace seam
