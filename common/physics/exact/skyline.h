#pragma once
/// A symmetric positive matrix, stored by rows from each row's first entry to the diagonal, and its
/// L D L' of the same shape: entries before the first stay zero (George and Liu, "Computer Solution
/// of Large Sparse Positive Definite Systems", 1981, chapter 4). Rows may be left out without
/// changing the shape.

#include <cstddef>
#include <vector>

namespace seam {

class Skyline {
 public:
  /// Sets the shape; `first[i]` <= i: column of row i's first entry. Makes all entries 0.
  void SetShape(const std::vector<int>& first);
  int size() const { return static_cast<int>(first_.size()); }
  /// Returns the maximal cost of a Factor of such a shape, multiplications.
  static long Cost(const std::vector<int>& first);
  /// The cost of Factor from this row on; and of a Solve.
  long CostFrom(int row) const { return cost_.back() - cost_[static_cast<std::size_t>(row)]; }
  long SolveCost() const { return 2 * static_cast<long>(matrix_.size()); }
  /// Sets the entries of rows from `from` on to 0.
  void Clear(int from = 0);
  /// Returns the entry's index for `At`; requires first[row] <= column <= row.
  int Place(int row, int column) const { return start_[static_cast<std::size_t>(row)] + column; }
  double& At(int place) { return matrix_[static_cast<std::size_t>(place)]; }
  double At(int place) const { return matrix_[static_cast<std::size_t>(place)]; }

  /// Factors the rows with `in[i]` set; all others become rows of the identity. Rows before `from`
  /// must be as at the last call. A row that depends on those before it (to 1e-10 of its diagonal)
  /// gets no share.
  void Factor(const std::vector<char>& in, int from);
  /// Computes x = A^-1 x; left-out rows keep 0. Requires x = 0 there.
  void Solve(std::vector<double>* x) const { SolvePart(x, 0, size()); }
  /// Like Solve, for rows from..to-1 alone. Requires that these rows have no entries in common with
  /// others.
  void SolvePart(std::vector<double>* x, int from, int to) const;

 private:
  using Two = double __attribute__((vector_size(16)));
  void FactorOne(const char* in, int row);
  void FactorTwo(const char* in, int row);

  std::vector<int> first_, start_;  // entry (i, k) is at start_[i] + k
  std::vector<long> cost_{0};       // cost of the rows before each; the last is the total
  std::vector<double> matrix_, factor_, inverse_;  // inverse_: of D
  std::vector<char>
      leads_;  // true if a row is factored with the next one, which begins in the same column
  std::vector<Two> two_;  // scratch space for two rows side by side
};

}  // namespace seam
