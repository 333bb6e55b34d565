#pragma once
/// Disjoint sets of integers (union-find with path halving) in one flat array. The lowest member
/// represents a set, so that results do not depend on the order of the unions.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace seam {

class DisjointSets {
 public:
  /// Creates the sets {0} to {count - 1}.
  explicit DisjointSets(std::size_t count) : up_(count) { Separate(); }

  /// Makes each number a set of its own again.
  void Separate() { std::iota(up_.begin(), up_.end(), 0); }

  /// Returns the lowest member of the set of `of`.
  int Find(int of) {
    while (At(of) != of) {
      At(of) = At(At(of));
      of = At(of);
    }
    return of;
  }
  bool Same(int a, int b) { return Find(a) == Find(b); }
  void Unite(int a, int b) {
    a = Find(a);
    b = Find(b);
    At(std::max(a, b)) = std::min(a, b);
  }
  /// Returns by member: the lowest member of its set.
  std::vector<int> Lowest() {
    std::vector<int> lowest(up_.size());
    for (std::size_t i = 0; i < up_.size(); ++i) lowest[i] = Find(static_cast<int>(i));
    return lowest;
  }

 private:
  int& At(int i) { return up_[static_cast<std::size_t>(i)]; }

  std::vector<int> up_;
};

}  // namespace seam
