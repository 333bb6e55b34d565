#pragma once
/// All pairs of boxes that overlap when each is grown: a sweep along the axis along which they are
/// spread most, n log n for what does not crowd.

#include <algorithm>
#include <vector>

#include "common/sync/reach/zones.h"

namespace seam {

class BoxSweep {
 public:
  /// `grow` (of a box): m on all sides.
  template <class Grow>
  BoxSweep(const std::vector<MovingBox>& boxes, const Grow& grow) {
    Vec2 low(0, 0), high(0, 0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      low = i == 0 ? boxes[i].min : low.cwiseMin(boxes[i].min);
      high = i == 0 ? boxes[i].max : high.cwiseMax(boxes[i].max);
    }
    const int along = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    spans_.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const MovingBox& box = boxes[i];
      const float more = grow(box) + kRounding;
      spans_.push_back({box.min[along] - more, box.max[along] + more, box.min[1 - along] - more,
                        box.max[1 - along] + more, i});
    }
    std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) {
      return a.from != b.from ? a.from < b.from : a.box < b.box;
    });
  }

  /// Calls `visit` (two indices) once for each pair.
  template <class Visit>
  void EachPair(const Visit& visit) const {
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const Span& a = spans_[i];
      for (std::size_t j = i + 1; j < spans_.size() && spans_[j].from <= a.to; ++j) {
        const Span& b = spans_[j];
        if (b.low <= a.high && a.low <= b.high) visit(a.box, b.box);
      }
    }
  }

 private:
  /// m; by rounding no pair may be missed.
  static constexpr float kRounding = 0.01f;
  struct Span {
    float from, to;   // along the sweep
    float low, high;  // at right angles to it
    std::size_t box;
  };
  std::vector<Span> spans_;
};

}  // namespace seam
