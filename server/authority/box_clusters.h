#pragma once
/// Clusters of neighbouring boxes of one mechanism, for a broad phase: pairs of clusters are
/// compared before pairs of boxes. A car of three bodies is one box to everything far from it.

#include <algorithm>
#include <vector>

#include "common/sync/reach/zones.h"

namespace seam {

class BoxClusters {
 public:
  /// Boxes per cluster, and the longest side of a cluster, m: a long chain makes several.
  static constexpr std::size_t kMost = 8;
  static constexpr float kLongest = 6;

  /// Clusters boxes that are adjacent in the list and of the same group.
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
  /// Returns the bounding box and group of each cluster; its velocity is the first box's.
  const std::vector<MovingBox>& around() const { return around_; }
  int GroupOf(std::size_t cluster) const { return around_[cluster].group; }
  /// The cluster's boxes are the index range [begin, end).
  std::size_t begin(std::size_t cluster) const { return begin_[cluster]; }
  std::size_t end(std::size_t cluster) const { return begin_[cluster + 1]; }

  /// Calls `visit` (index of a box) for each of its boxes.
  template <class Visit>
  void Each(std::size_t cluster, const Visit& visit) const {
    for (std::size_t i = begin(cluster); i < end(cluster); ++i) visit(i);
  }
  /// True if `test` (index of a box) holds for any of its boxes.
  template <class Test>
  bool Any(std::size_t cluster, const Test& test) const {
    for (std::size_t i = begin(cluster); i < end(cluster); ++i) {
      if (test(i)) return true;
    }
    return false;
  }
  /// Calls `visit` (two indices of boxes) for each pair of boxes of two clusters.
  template <class Visit>
  void EachPair(std::size_t a, std::size_t b, const Visit& visit) const {
    for (std::size_t i = begin(a); i < end(a); ++i) {
      for (std::size_t j = begin(b); j < end(b); ++j) visit(i, j);
    }
  }

 private:
  /// Adds box `i` to the last cluster if it fits; else returns false.
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
