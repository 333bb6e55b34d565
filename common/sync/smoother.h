#pragma once
/// Keeps corrections out of sight: physics jumps, the view glides.

#include <vector>

#include "common/scene/types.h"

namespace seam {

/// A visual offset per body, with a velocity of its own. A correction moves the physics state by d;
/// the offset takes -d, so the view stays where it was, and then comes back to zero like a
/// critically damped spring: its velocity is continuous too, where plain exponential decay (after
/// Fiedler, "State Synchronization", 2015) begins each glide with a jerk. Of a correction of
/// velocity the offset takes a share, with a cap on the speed of the glide, because a large
/// offset would glide too fast.
class Smoother {
 public:
  Smoother(int body_count, bool enabled);

  /// The physics state of `body` was changed by this much.
  void Moved(int body, const BodyState& by);
  /// The body was placed anew (joined, hand-over of the unknown): show it there at once.
  void Reset(int body);
  /// Lets a frame pass. `speed` of the body (m/s) widens the cap: a fast body hides a fast glide.
  void Advance(int body, float dt, float speed);

  /// The bodies have changed; origins[i] is the body before that body i comes from, -1 for none.
  void Remap(const std::vector<int>& origins);

  const Vec2& offset(int body) const;
  float angle_offset(int body) const;

 private:
  struct Offset {
    Vec2 position{0, 0};  // m
    Vec2 velocity{0, 0};  // m/s
    float angle = 0;      // rad
    float spin = 0;       // rad/s
  };
  bool enabled_;
  std::vector<Offset> offsets_;
};

}  // namespace seam
