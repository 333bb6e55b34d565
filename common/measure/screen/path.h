#pragma once
/// One body's poses tick by tick: as a peer displays them, or as the oracle has them.

#include <cstdint>
#include <map>
#include <vector>

#include "common/measure/oracle.h"
#include "common/measure/revisions.h"
#include "common/measure/screen/extent.h"

namespace seam {

/// Displacement and rotation as one vector: m, m, and the rotation as arc length at the radius, m.
using Place3 = Eigen::Vector3d;

/// Poses of one body over a range of ticks, with gaps.
class BodyPath {
 public:
  BodyPath(std::int64_t first_tick, std::int64_t last_tick);

  std::int64_t first() const { return first_; }
  std::int64_t last() const { return first_ + static_cast<std::int64_t>(samples_.size()) - 1; }
  /// Returns the first tick at which the pose is known; last() + 1 if it never is.
  std::int64_t first_known() const { return known_ < 0 ? last() + 1 : known_; }
  /// True if the pose is known at the tick.
  bool Has(std::int64_t tick) const;
  /// True if the pose is known in all these ticks, and the body has the same parts.
  bool Whole(std::int64_t from, std::int64_t to) const;
  /// Requires Has.
  const DoublePose& At(std::int64_t tick) const;
  /// Interpolates linearly between two ticks. Requires Has at both.
  DoublePose At(double tick) const;
  bool Has(double tick) const;
  bool Whole(double from, double to) const;

  /// Sets the pose of a tick. `same`: the body has the same parts as in the tick before.
  void Set(std::int64_t tick, const DoublePose& pose, bool same);

 private:
  struct Sample {
    DoublePose pose;
    int form = -1;  // increases when the body's parts change or after a gap; -1: not known
  };
  const Sample* Find(std::int64_t tick) const;

  std::int64_t first_, known_ = -1;
  std::vector<Sample> samples_;
  int form_ = 0;
};

/// Returns the displacement from `a` to `b`; the rotation is wrapped to +-pi and multiplied by
/// `radius` (m).
inline Place3 Between(const DoublePose& a, const DoublePose& b, double radius) {
  const Eigen::Vector2d d = b.position - a.position;
  return {d.x(), d.y(), radius * WrapAngle(b.angle - a.angle)};
}

/// Returns a peer's views by tick since the recording's first; nullptr where there is none.
std::vector<const View*> ViewsByTick(const Recording& recording, int peer);

/// Returns a body's displayed path. `views`: of ViewsByTick. `revisions` nullptr: bodies never
/// change.
BodyPath ShownPath(const Recording& recording, const std::vector<const View*>& views,
                   const RevisionHistory* revisions, PartId id);

/// Returns the oracle's path of a body, from a second before the recording's first tick or from the
/// oracle's first tick.
BodyPath TruePath(const Recording& recording, const Oracle& oracle, PartId id);

/// Returns the ids of all bodies that any view shows, ascending.
std::vector<PartId> ShownIds(const Recording& recording);

}  // namespace seam
