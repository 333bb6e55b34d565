#pragma once
/// How the bodies after a change of topology come from the bodies before it.

#include <Eigen/Core>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// Where a body's motion comes from: the body that its root part belonged to.
struct BodyOrigin {
  int body = -1;      ///< index before; -1: was anchored, or is new
  bool same = false;  ///< the same parts under the same root
  // In the frame of the root before, m and rad:
  Eigen::Vector2d root{0, 0};  ///< the root part now
  double angle = 0;
  Eigen::Vector2d centre{0, 0};         ///< the centre of mass of the parts that came from there
  Eigen::Vector2d centre_before{0, 0};  ///< that of the whole body before
};

struct BodyRemap {
  std::vector<BodyOrigin> bodies;  ///< by body, as they are now
  /// By body: how a bond moved it that moved another body of its mechanism; empty: it moved none.
  std::vector<BodyState> jumps;
  /// By mechanism, as they are now: those before that parts of it were in, ascending, but first
  /// that of the mechanism's first body; empty when all is new or was anchored.
  std::vector<std::vector<int>> mechanisms;
};

/// The state that a body has now (or had then, as part of another) when the body it comes from has
/// `before`: the same rigid motion. Requires origin.body >= 0.
BodyState Carried(const BodyOrigin& origin, const BodyState& before);

}  // namespace seam
