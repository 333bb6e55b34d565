#pragma once
/// Distance from a box to the nearest of a set of boxes, without visiting all of them.

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <vector>

#include "common/sync/reach/zones.h"

namespace seam {

class NearestBox {
 public:
  /// Sorts the range [begin, end) of `indices` as the constructor needs it: by left side.
  static void Sort(const std::vector<MovingBox>& boxes, int begin, int end,
                   std::vector<int>* indices) {
    const auto left = [&](int i) { return boxes[static_cast<std::size_t>(i)].min.x(); };
    std::sort(indices->begin() + begin, indices->begin() + end,
              [&](int a, int b) { return left(a) != left(b) ? left(a) < left(b) : a < b; });
  }

  /// Takes the boxes that the sorted range [begin, end) of `indices` names. All arguments must
  /// outlive this object.
  NearestBox(const std::vector<MovingBox>& boxes, const std::vector<int>& indices, int begin,
             int end)
      : boxes_(boxes), indices_(indices), begin_(begin), end_(end) {
    if (any()) around_ = At(begin);
    for (int k = begin; k < end; ++k) {
      widest_ = std::max(widest_, At(k).max.x() - At(k).min.x());
      around_.min = around_.min.cwiseMin(At(k).min);
      around_.max = around_.max.cwiseMax(At(k).max);
    }
  }

  bool any() const { return begin_ < end_; }
  /// Returns the bounding box of the set. Requires any().
  const MovingBox& around() const { return around_; }

  /// Returns the distance as defined by Gap, m; FLT_MAX: the set is empty.
  float DistanceTo(const MovingBox& box) const {
    // Starts at the first box that begins right of `box` and goes both ways until the distance
    // along x alone exceeds the best.
    int right = begin_, count = end_ - begin_;
    while (count > 0) {
      const int half = count / 2;
      if (At(right + half).min.x() < box.min.x()) {
        right += half + 1;
        count -= half + 1;
      } else {
        count = half;
      }
    }
    float best = FLT_MAX;  // m^2
    for (int k = right; k < end_; ++k) {
      const float way = At(k).min.x() - box.max.x();
      if (way > 0 && way * way > best) break;
      best = std::min(best, Square(box, At(k)));
    }
    for (int k = right - 1; k >= begin_; --k) {
      const float way = box.min.x() - (At(k).min.x() + widest_);
      if (way > 0 && way * way > best) break;
      best = std::min(best, Square(box, At(k)));
    }
    return best == FLT_MAX ? FLT_MAX : std::sqrt(best);
  }

  /// True if one of the set is within `reach`, m.
  bool Within(const MovingBox& box, float reach) const {
    for (int k = begin_; k < end_; ++k) {
      const float way = At(k).min.x() - box.max.x();
      if (way > reach) return false;
      if (Square(box, At(k)) <= reach * reach) return true;
    }
    return false;
  }

 private:
  const MovingBox& At(int k) const {
    return boxes_[static_cast<std::size_t>(indices_[static_cast<std::size_t>(k)])];
  }
  static float Square(const MovingBox& a, const MovingBox& b) {
    const float x = std::max({a.min.x() - b.max.x(), b.min.x() - a.max.x(), 0.0f});
    const float y = std::max({a.min.y() - b.max.y(), b.min.y() - a.max.y(), 0.0f});
    return x * x + y * y;
  }

  const std::vector<MovingBox>& boxes_;
  const std::vector<int>& indices_;
  const int begin_, end_;
  MovingBox around_;
  float widest_ = 0;  // m along x
};

}  // namespace seam
