#pragma once
/// The CSV file of a sweep: complete lines in the order of the grid at any moment, whenever the
/// program was killed.

#include <cstdio>
#include <string>
#include <vector>

namespace seam {

class SweepTable {
 public:
  /// Takes over the rows that an earlier run left in `path`; a last line without its end is
  /// dropped. `keys`: of all rows in order, each the first `key_columns` values of its line.
  /// Throws OperatorError when the file has other columns or rows, unless `force` (then it begins
  /// anew), or cannot be written.
  SweepTable(const std::string& path, const std::string& header, int key_columns,
             const std::vector<std::string>& keys, bool force);
  ~SweepTable();
  SweepTable(const SweepTable&) = delete;
  SweepTable& operator=(const SweepTable&) = delete;

  bool Has(std::size_t row) const { return !lines_[row].empty(); }
  /// Empty when it is not there yet.
  const std::string& line(std::size_t row) const { return lines_[row]; }
  std::size_t count() const { return count_; }
  /// `line` without its end, beginning with the row's key. Throws OperatorError when the disk is
  /// full.
  void Add(std::size_t row, const std::string& line);

 private:
  void Load(const std::string& text, int key_columns, const std::vector<std::string>& keys);
  void Rewrite();

  std::string path_, header_;
  std::vector<std::string> lines_;  // by row; empty: not there yet
  std::size_t count_ = 0;
  std::size_t end_ = 0;        // one behind the last row in the file
  std::FILE* file_ = nullptr;  // open to append
};

}  // namespace seam
