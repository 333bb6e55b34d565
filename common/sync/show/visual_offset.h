#pragma once
/// How a visual offset comes back to zero: that of a body alone, and those of a mechanism, which
/// come back as one motion so that no joint is pulled open on the way.

#include <vector>

#include "common/physics/pin.h"
#include "common/scene/types.h"

namespace seam {

/// By how much a body is shown beside where physics has it.
struct VisualOffset {
  Vec2 position{0, 0};  ///< m, of the body's origin
  Vec2 velocity{0, 0};  ///< m/s, of the centre of mass as a BodyState's
  float angle = 0;      ///< rad
  float spin = 0;       ///< rad/s

  bool zero() const { return position == Vec2(0, 0) && velocity == Vec2(0, 0) && !angle && !spin; }
};

/// A body of a mechanism with its offset. The pose is that of physics.
struct OffsetBody {
  MassPoint mass;
  BodyState pose;
  VisualOffset* offset = nullptr;
};

/// Lets `dt` s pass for a body that is alone and `speed` m/s fast; `rate`: of the return, 1/s.
/// 1/rate is its time constant. Faster shows corrections as jerks, slower shows stale poses for
/// longer (docs/lessons.md).
void ReturnAlone(float dt, float rate, float speed, VisualOffset* offset);

/// The same for all bodies of a mechanism. Their offsets are split into the rigid motion that is
/// common to them by mass, a shift of the centre of mass and a turn about it, and what each has
/// beside it; both come back at the same rate, each below its own speed limit. Offsets that are a
/// rigid motion stay one, however large the turn. `gentle`: a lower limit.
void ReturnTogether(float dt, float rate, const std::vector<OffsetBody>& bodies,
                    bool gentle = false);

}  // namespace seam
