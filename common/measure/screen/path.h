#pragma once
/// One body's poses tick by tick: what a peer shows of it, or where the oracle has it.

#include <cstdint>
#include <map>
#include <vector>

#include "common/measure/oracle.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/extent.h"

namespace seam {

/// Position and turn as one vector: m, m, and the turn as the way of a point at a body's radius.
using Place3 = Eigen::Vector3d;

class BodyPath {
 public:
  BodyPath(std::int64_t first_tick, std::int64_t last_tick);

  std::int64_t first() const { return first_; }
  std::int64_t last() const { return first_ + static_cast<std::int64_t>(samples_.size()) - 1; }
  /// The body is known there.
  bool Has(std::int64_t tick) const;
  /// It is known in all these ticks, and of the same parts.
  bool Whole(std::int64_t from, std::int64_t to) const;
  /// Requires Has.
  const DoublePose& At(std::int64_t tick) const;
  /// Between two ticks, on the straight way. Requires Has at both.
  DoublePose At(double tick) const;
  bool Has(double tick) const;
  bool Whole(double from, double to) const;

  /// `same`: of the same parts as in the tick before.
  void Set(std::int64_t tick, const DoublePose& pose, bool same);

 private:
  struct Sample {
    DoublePose pose;
    int form = -1;  // rises whenever the body is not what it was; -1: not known
  };
  const Sample* Find(std::int64_t tick) const;

  std::int64_t first_;
  std::vector<Sample> samples_;
  int form_ = 0;
};

/// From `a` to `b`, the turn wrapped to half a turn either way and multiplied by `radius` (m).
inline Place3 Between(const DoublePose& a, const DoublePose& b, double radius) {
  const Eigen::Vector2d d = b.position - a.position;
  return {d.x(), d.y(), radius * WrapAngle(b.angle - a.angle)};
}

/// A peer's views by tick, nullptr where there is none.
std::vector<const View*> ViewsByTick(const Recording& recording, int peer);

/// `revisions` nullptr: bodies never change. `views`: ViewsByTick.
BodyPath ShownPath(const Recording& recording, const std::vector<const View*>& views,
                   const RevisionHistory* revisions, PartId id);

/// From a second before the recording's first tick on, as far as the oracle goes.
BodyPath TruePath(const Recording& recording, const Oracle& oracle, PartId id);

/// Ids of all bodies that any view shows, ascending.
std::vector<PartId> ShownIds(const Recording& recording);

}  // namespace seam
