#pragma once
/// Maps the bodies after a change of topology to the bodies before it.

#include <Eigen/Core>
#include <vector>

#include "common/scene/types.h"

namespace seam {

/// Origin of a body's motion: the earlier body that its root part belonged to.
struct BodyOrigin {
  int body = -1;      ///< index before the change; -1: anchored or absent then
  bool same = false;  ///< the same parts with the same root
  // In the frame of the root before, m and rad:
  Eigen::Vector2d root{0, 0};  ///< root part after the change
  double angle = 0;
  Eigen::Vector2d centre{0, 0};         ///< centre of mass of the parts that came from `body`
  Eigen::Vector2d centre_before{0, 0};  ///< centre of mass of the whole earlier body
};

struct BodyRemap {
  std::vector<BodyOrigin> bodies;  ///< by body after the change
  /// By body after the change: displacement caused by a bond that moved another body of the same
  /// mechanism. Empty if no bond moved anything.
  std::vector<BodyState> jumps;
  /// By mechanism after the change: earlier mechanisms that its parts were in, ascending, except
  /// that the mechanism of its first body comes first. Empty if all parts are new or were anchored.
  std::vector<std::vector<int>> mechanisms;
};

/// Returns the state of a body if its earlier body had the state `before`, by the same rigid
/// motion; also valid for past ticks. Requires origin.body >= 0.
BodyState Carried(const BodyOrigin& origin, const BodyState& before);

}  // namespace seam
