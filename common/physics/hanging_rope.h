#pragma once
/// A rope that hangs on a point and that nothing feels: the engine's b2Rope, positions made to fit
/// their lengths (Müller and others, "Position Based Dynamics", 2007). For what is only looked at.

#include <memory>
#include <vector>

#include "common/scene/strand.h"

namespace seam {

class HangingRope {
 public:
  /// Hanging straight down (along gravity) from a point, m.
  HangingRope(const Strand& strand, const Vec2& gravity, const Vec2& at);
  ~HangingRope();
  HangingRope(HangingRope&&) noexcept;

  /// Lets `h` s pass while the upper end goes to a point. One that is further away than the rope is
  /// long was not gone to but placed: the rope hangs there anew.
  void Step(float h, const Vec2& at);
  /// m, from the upper end: strand.links + 1 of them.
  std::vector<Vec2> Points() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
