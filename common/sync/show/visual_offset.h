#pragma once
/// Returns visual offsets to zero: a single body's by itself, a mechanism's as one motion, so that
/// no joint is pulled open meanwhile.

#include <vector>

#include "common/physics/pin.h"
#include "common/scene/types.h"

namespace seam {

/// Displayed pose less simulated pose.
struct VisualOffset {
  Vec2 position{0, 0};  ///< m, of the body's origin
  Vec2 velocity{0, 0};  ///< m/s, of the centre of mass, as in BodyState
  float angle = 0;      ///< rad
  float spin = 0;       ///< rad/s

  bool zero() const { return position == Vec2(0, 0) && velocity == Vec2(0, 0) && !angle && !spin; }
};

/// A body of a mechanism with its offset. The pose is the simulated one.
struct OffsetBody {
  MassPoint mass;
  BodyState pose;
  VisualOffset* offset = nullptr;
};

/// Advances the offset of a single body by `dt` s. `speed` of the body, m/s; `rate` of the return,
/// 1/s; 1/rate is its time constant. A faster return shows corrections as jerks, a slower one shows
/// stale poses for longer (docs/lessons.md).
void ReturnAlone(float dt, float rate, float speed, VisualOffset* offset);

/// Advances the offsets of a mechanism's bodies. They are split into their common rigid motion
/// (shift of the centre of mass and turn about it, weighted by mass) and each body's remainder.
/// Both return at the same rate, each below its own speed limit. Offsets that form a rigid motion
/// stay one, however large the turn. `gentle`: a lower limit.
void ReturnTogether(float dt, float rate, const std::vector<OffsetBody>& bodies,
                    bool gentle = false);

}  // namespace seam
