#pragma once
/// Keeps corrections out of sight: physics jumps, the view glides.

#include <vector>

#include "common/physics/types.h"

namespace seam {

/// A visual offset per body. A correction moves the physics state by d; the offset takes -d, so the
/// view stays where it was, and then decays. After Fiedler, "State Synchronization" (2015): x0.95
/// per 1/60 s for small offsets, x0.85 for large ones; here with a cap on the speed of the glide,
/// because the decay of a large offset shows as a burst of speed.
class Smoother {
 public:
  Smoother(int body_count, bool enabled);

  /// The physics state of `body` was moved by this much.
  void Moved(int body, const Vec2& by, float by_angle);
  /// The body was placed anew (joined, hand-over of the unknown): show it there at once.
  void Reset(int body);
  /// Lets a frame pass. `speed` of the body (m/s) widens the cap: a fast body hides a fast glide.
  void Advance(int body, float dt, float speed);

  const Vec2& offset(int body) const;
  float angle_offset(int body) const;

 private:
  struct Offset {
    Vec2 position{0, 0};
    float angle = 0;
  };
  bool enabled_;
  std::vector<Offset> offsets_;
};

}  // namespace seam
