#pragma once
/// Finds all pairs of boxes that overlap when each is grown. Sweeps along the axis of greatest
/// spread, in strips across it; linear in the number of boxes if they are not crowded.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/base/sort_keys.h"
#include "common/sync/reach/zones.h"

namespace seam {

/// m; a margin so that rounding misses no pair.
constexpr float kPairRounding = 0.01f;

///        strip 1 |      +--a--+         a and b are in both strips: the pair is visited in the
///       ---------+------|-+---|-+-----  first that both are in
///        strip 0 |      +-|---+ b
///                         +-----+     --> along
class BoxSweep {
 public:
  /// `grow` (of a box's index) returns the margin on all sides, m.
  template <class Grow>
  BoxSweep(const std::vector<MovingBox>& boxes, const Grow& grow) {
    grown_.reserve(boxes.size());
    Vec2 low(0, 0), high(0, 0), sides(0, 0);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const MovingBox& box = boxes[i];
      low = i == 0 ? box.min : low.cwiseMin(box.min);
      high = i == 0 ? box.max : high.cwiseMax(box.max);
      grown_.push_back(grow(i) + kPairRounding);
      sides += box.max - box.min + 2 * Vec2(grown_.back(), grown_.back());
    }
    const int along = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    Divide(boxes.size(), low[1 - along], high[1 - along], sides[1 - along]);
    Fill(boxes, along);
  }

  /// Calls `visit` (two indices) once for each pair.
  template <class Visit>
  void EachPair(const Visit& visit) const {
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const Span& a = spans_[i];
      const std::size_t end = end_[static_cast<std::size_t>(a.strip)];
      for (std::size_t j = i + 1; j < end && spans_[j].from <= a.to; ++j) {
        if (Here(a, spans_[j])) visit(a.box, spans_[j].box);
      }
    }
  }
  /// Like EachPair, but only for pairs within `count` boxes of each other along the sweep. Returns
  /// true if there may be more pairs.
  template <class Visit>
  bool EachNearPair(std::size_t count, const Visit& visit) const {
    bool others = false;
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const Span& a = spans_[i];
      const std::size_t strip_end = end_[static_cast<std::size_t>(a.strip)];
      const std::size_t end = std::min(strip_end, i + 1 + count);
      std::size_t j = i + 1;
      for (; j < end && spans_[j].from <= a.to; ++j) {
        if (Here(a, spans_[j])) visit(a.box, spans_[j].box);
      }
      others = others || (j == end && end < strip_end && spans_[j].from <= a.to);
    }
    return others;
  }
  /// Like EachPair for the remaining pairs (EachNearPair of `count` has visited the rest), except
  /// pairs with the same label. `label` (of an index) is >= 0; below 0 excludes none of that box's
  /// pairs.
  template <class Label, class Visit>
  void EachPairApart(std::size_t count, const Label& label, const Visit& visit) const {
    // From each span: the next span with another label, or the end.
    std::vector<std::size_t> other(spans_.size());
    std::vector<int> labels(spans_.size());
    for (std::size_t i = spans_.size(); i-- > 0;) {
      labels[i] = label(spans_[i].box);
      const bool alike = i + 1 < spans_.size() && labels[i] >= 0 && labels[i + 1] == labels[i];
      other[i] = alike ? other[i + 1] : i + 1;
    }
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const Span& a = spans_[i];
      const std::size_t end = end_[static_cast<std::size_t>(a.strip)];
      for (std::size_t j = i + 1 + count; j < end && spans_[j].from <= a.to;) {
        if (labels[i] >= 0 && labels[j] == labels[i]) {
          j = other[j];
          continue;
        }
        if (Here(a, spans_[j])) visit(a.box, spans_[j].box);
        ++j;
      }
    }
  }

 private:
  /// Most strips, and the least height of a strip in mean heights of a grown box.
  static constexpr float kStripsMax = 256, kStripHeight = 1.5f;

  struct Span {
    float from, to;             // along the sweep
    float low, high;            // across the sweep
    std::int32_t strip, first;  // this strip, and the first one that the box is in
    std::uint32_t box;
  };

  bool Here(const Span& a, const Span& b) const {
    return b.low <= a.high && a.low <= b.high && std::max(a.first, b.first) == a.strip;
  }

  /// `heights` is the sum over all grown boxes.
  void Divide(std::size_t boxes, float low, float high, float heights) {
    low_ = low;
    if (boxes == 0) return;
    const float mean = heights / static_cast<float>(boxes);
    const float most = std::min(kStripsMax, static_cast<float>(boxes) / 8);
    strips_ = static_cast<int>(
        std::clamp((high - low) / (kStripHeight * mean), 1.0f, std::max(1.0f, most)));
    per_m_ = high > low ? static_cast<float>(strips_) / (high - low) : 0;
  }

  int StripOf(float at) const {
    return static_cast<int>(
        std::clamp((at - low_) * per_m_, 0.0f, static_cast<float>(strips_ - 1)));
  }

  void Fill(const std::vector<MovingBox>& boxes, int along) {
    std::vector<SortKey> keys, spare;
    keys.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      keys.push_back(static_cast<SortKey>(OrderedBits(boxes[i].min[along] - grown_[i])) << 32 | i);
    }
    SortByKey(&keys, &spare);
    end_.assign(static_cast<std::size_t>(strips_), 0);
    struct Strips {
      std::int32_t first = 0, last = 0;
    };
    std::vector<Strips> strips(boxes.size());  // strips of each box
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (strips_ > 1) {
        strips[i].first = StripOf(boxes[i].min[1 - along] - grown_[i]);
        strips[i].last = StripOf(boxes[i].max[1 - along] + grown_[i]);
      }
      for (int s = strips[i].first; s <= strips[i].last; ++s) ++end_[static_cast<std::size_t>(s)];
    }
    std::size_t sum = 0;
    for (std::size_t& end : end_) {  // start of each strip, until filled
      const std::size_t count = end;
      end = sum;
      sum += count;
    }
    spans_.resize(sum);
    for (const SortKey key : keys) {
      const auto i = static_cast<std::size_t>(key & 0xffffffffu);
      const float more = grown_[i];
      const Vec2 &min = boxes[i].min, &max = boxes[i].max;
      Span span{
          min[along] - more, max[along] + more, min[1 - along] - more,        max[1 - along] + more,
          strips[i].first,   strips[i].first,   static_cast<std::uint32_t>(i)};
      for (; span.strip <= strips[i].last; ++span.strip) {
        spans_[end_[static_cast<std::size_t>(span.strip)]++] = span;
      }
    }
  }

  std::vector<float> grown_;  // by box, m
  float low_ = 0, per_m_ = 0;
  int strips_ = 1;
  std::vector<Span> spans_;       // strip by strip, sorted by `from`
  std::vector<std::size_t> end_;  // by strip, in spans_
};

}  // namespace seam
