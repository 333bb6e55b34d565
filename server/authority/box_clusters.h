#pragma once
/// Boxes of one mechanism, a few as one: what is compared pair by pair is compared by these first,
/// so that a car of three bodies is one thing to what is far from it.

#include <algorithm>
#include <vector>

#include "common/sync/reach/zones.h"

namespace seam {

class BoxClusters {
 public:
  /// Boxes in one, and how long its longer side may be, m: a long chain is several.
  static constexpr std::size_t kMost = 8;
  static constexpr float kLongest = 6;

  /// Of boxes that stand beside each other in the list and are of one group.
  explicit BoxClusters(const std::vector<MovingBox>& boxes) {
    around_.reserve(boxes.size());
    begin_.reserve(boxes.size() + 1);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!Joins(boxes[i], i)) {
        around_.push_back(boxes[i]);
        begin_.push_back(i);
      }
    }
    begin_.push_back(boxes.size());
  }

  std::size_t count() const { return around_.size(); }
  /// Corners and group of each; it moves as its first box.
  const std::vector<MovingBox>& around() const { return around_; }
  int GroupOf(std::size_t cluster) const { return around_[cluster].group; }
  /// Its boxes, by index: from one, up to before the other.
  std::size_t begin(std::size_t cluster) const { return begin_[cluster]; }
  std::size_t end(std::size_t cluster) const { return begin_[cluster + 1]; }

  /// Calls `visit` (the index of a box) for each of its boxes.
  template <class Visit>
  void Each(std::size_t cluster, const Visit& visit) const {
    for (std::size_t i = begin(cluster); i < end(cluster); ++i) visit(i);
  }
  /// Whether `test` (of the index of a box) is true of any of its boxes.
  template <class Test>
  bool Any(std::size_t cluster, const Test& test) const {
    for (std::size_t i = begin(cluster); i < end(cluster); ++i) {
      if (test(i)) return true;
    }
    return false;
  }
  /// Calls `visit` (two indices of boxes) for each pair of the boxes of two of them.
  template <class Visit>
  void EachPair(std::size_t a, std::size_t b, const Visit& visit) const {
    for (std::size_t i = begin(a); i < end(a); ++i) {
      for (std::size_t j = begin(b); j < end(b); ++j) visit(i, j);
    }
  }

 private:
  /// Whether box `i` becomes part of the last cluster.
  bool Joins(const MovingBox& box, std::size_t i) {
    if (around_.empty() || around_.back().group != box.group) return false;
    MovingBox& last = around_.back();
    const Vec2 min = last.min.cwiseMin(box.min), max = last.max.cwiseMax(box.max);
    if (i - begin_.back() >= kMost || (max - min).maxCoeff() > kLongest) return false;
    last.min = min;
    last.max = max;
    return true;
  }

  std::vector<MovingBox> around_;   // by cluster
  std::vector<std::size_t> begin_;  // by cluster, and one more
};

}  // namespace seam
