#pragma once
/// Keeps corrections out of sight: physics jumps, the view glides.

#include <vector>

#include "common/physics/world.h"
#include "common/scene/types.h"
#include "common/sync/show/visual_offset.h"

namespace seam {

/// A visual offset per body, with a velocity of its own. A correction moves the physics state by d;
/// the offset takes -d, so the view stays where it was, and then comes back to zero like a
/// critically damped spring: its velocity is continuous too, where plain exponential decay (after
/// Fiedler, "State Synchronization", 2015) begins each glide with a jerk. Of a correction of
/// velocity the offset takes a share, with a cap on the speed of the glide, because a large
/// offset would glide too fast.
class Smoother {
 public:
  /// `rate`: of the return, 1/s; 0: nothing is hidden.
  Smoother(int body_count, float rate);

  /// The physics state of `body` was changed by this much.
  void Moved(int body, const BodyState& by);
  /// The view was moved: the body is shown this far beside physics now. The glide goes on as fast.
  void Set(int body, const BodyState& beside);
  /// The body was placed anew (joined, hand-over of the unknown): show it there at once.
  void Reset(int body);
  /// Lets a frame pass. `speed` of the body (m/s) widens the cap: a fast body hides a fast glide.
  void Advance(int body, float dt, float speed) { ReturnAlone(dt, rate_, speed, &At(body)); }
  /// The same for all bodies of a mechanism of more than one. Where one jump has moved all of them
  /// rigidly, the view comes back rigidly. `gentle`: no faster than 2 m/s.
  void AdvanceTogether(const World& world, const std::vector<int>& bodies, bool gentle = false);

  /// The bodies have changed; origins[i] is the body before that body i comes from, -1 for none.
  void Remap(const std::vector<int>& origins);

  const Vec2& offset(int body) const;
  float angle_offset(int body) const;
  /// Whether the body is shown anywhere but where physics has it.
  bool active(int body) const { return angle_offset(body) != 0 || offset(body) != Vec2(0, 0); }

 private:
  VisualOffset& At(int body) { return offsets_[static_cast<std::size_t>(body)]; }

  float rate_;
  std::vector<VisualOffset> offsets_;
};

}  // namespace seam
