#pragma once
/// A rope for display only: it hangs on a point and acts on nothing. Uses the engine's b2Rope,
/// position-based dynamics (Müller and others, "Position Based Dynamics", 2007).

#include <memory>
#include <vector>

#include "common/scene/strand.h"

namespace seam {

class HangingRope {
 public:
  /// Hangs straight down (along gravity) from a point, m.
  HangingRope(const Strand& strand, const Vec2& gravity, const Vec2& at);
  ~HangingRope();
  HangingRope(HangingRope&&) noexcept;

  /// Advances by `h` s while the upper end moves to a point. If that is farther away than the rope
  /// is long, the rope is placed there anew instead.
  void Step(float h, const Vec2& at);
  /// Returns the points, m, from the upper end on: strand.links + 1.
  std::vector<Vec2> Points() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
