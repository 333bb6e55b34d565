#pragma once
/// Hides corrections: the simulated state jumps, the view glides.

#include <functional>
#include <vector>

#include "common/physics/world.h"
#include "common/scene/types.h"
#include "common/sync/show/visual_offset.h"
#include "common/sync/table/body_column.h"

namespace seam {

/// Visual offset per body, with a velocity of its own. A correction moves the simulated state by d;
/// the offset takes -d, so the view stays, and then returns to zero like a critically damped
/// spring. Its velocity is continuous too, while plain exponential decay (after Fiedler, "State
/// Synchronization", 2015) starts each glide with a jerk. The offset takes a share of a velocity
/// correction. The glide's speed is capped, because a large offset would glide too fast.
class Smoother {
 public:
  /// `rate` of the return, 1/s; 0: nothing is hidden.
  Smoother(const BodyTable& table, float rate);

  /// Reports that the simulated state of `body` changed by this much.
  void Moved(int body, const BodyState& by);
  /// Sets the offset of the displayed from the simulated state. The glide keeps its velocity.
  void Set(int body, const BodyState& beside);
  /// Shows the body at once where it was placed anew (join, or hand-over of an unknown body).
  void Reset(int body);
  /// Advances by a frame. `speed` of the body (m/s) widens the cap: a fast body hides a fast glide.
  void Advance(int body, float dt, float speed) { ReturnAlone(dt, rate_, speed, &At(body)); }
  /// Like Advance, for all bodies of a mechanism of several. If one jump has moved all of them
  /// rigidly, the view returns rigidly. `base`: returns the state that a body is displayed beside.
  /// `gentle`: no faster than 2 m/s.
  void AdvanceTogether(const World& world, const std::vector<int>& bodies,
                       const std::function<BodyState(int)>& base, bool gentle = false);

  const Vec2& offset(int body) const;
  float angle_offset(int body) const;
  /// True if the body is displayed anywhere but at its simulated pose.
  bool active(int body) const { return angle_offset(body) != 0 || offset(body) != Vec2(0, 0); }

 private:
  VisualOffset& At(int body) { return offsets_[body]; }

  float rate_;
  BodyColumn<VisualOffset> offsets_;
};

}  // namespace seam
