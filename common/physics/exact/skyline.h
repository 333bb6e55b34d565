#pragma once
/// A symmetric positive matrix stored by rows from each row's first entry to the diagonal, and its
/// L D L' in place of that: entries before the first stay zero (George and Liu, "Computer Solution
/// of Large Sparse Positive Definite Systems", 1981, chapter 4). Rows may be left out without
/// changing the shape.

#include <cstddef>
#include <vector>

namespace seam {

class Skyline {
 public:
  /// `first[i]` <= i: column of row i's first entry. All entries are 0 then.
  void SetShape(const std::vector<int>& first);
  int size() const { return static_cast<int>(first_.size()); }
  /// What one Factor of such a shape costs at most, multiplications.
  static long Cost(const std::vector<int>& first);
  /// The same of Factor from this row on; and of one Solve.
  long CostFrom(int row) const { return cost_.back() - cost_[static_cast<std::size_t>(row)]; }
  long SolveCost() const { return 2 * static_cast<long>(matrix_.size()); }
  /// Makes the entries of rows from `from` on 0.
  void Clear(int from = 0);
  /// Where the entry is, for `At`; requires first[row] <= column <= row.
  int Place(int row, int column) const { return start_[static_cast<std::size_t>(row)] + column; }
  double& At(int place) { return matrix_[static_cast<std::size_t>(place)]; }
  double At(int place) const { return matrix_[static_cast<std::size_t>(place)]; }

  /// Factors what `in[i]` has; the others become rows of the identity. Rows before `from` are as at
  /// the last call. A row that depends on those before it (to 1e-10 of its diagonal) gets no share.
  void Factor(const std::vector<char>& in, int from);
  /// x = A^-1 x, rows that are out keep 0. Requires x = 0 there.
  void Solve(std::vector<double>* x) const { SolvePart(x, 0, size()); }
  /// The same of rows from..to-1, when no row beyond has an entry in their columns and they have
  /// none in columns before.
  void SolvePart(std::vector<double>* x, int from, int to) const;

 private:
  using Two = double __attribute__((vector_size(16)));
  void FactorOne(const char* in, int row);
  void FactorTwo(const char* in, int row);

  std::vector<int> first_, start_;                 // entry (i, k) is at start_[i] + k
  std::vector<long> cost_{0};                      // of the rows before each; in the end of all
  std::vector<double> matrix_, factor_, inverse_;  // the last of D
  std::vector<char>
      leads_;             // whether a row and the next one, which begins where it does, go together
  std::vector<Two> two_;  // room for two rows side by side
};

}  // namespace seam
