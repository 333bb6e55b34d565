#pragma once
/// How far a part is from where it should be.

#include <Eigen/Core>
#include <optional>

#include "common/scene/scene.h"

namespace seam {

/// Where a part's frame should be; what is not said may be anything.
struct WantedPose {
  std::optional<double> x, y;   ///< m
  std::optional<double> angle;  ///< rad; whole turns do not matter
};

/// The farthest that any point of the part's shape is from its place in the wanted pose, m: exact
/// for all shapes. What is not wanted counts as right: with x and y alone it is the distance of the
/// part's centre. NaN when the state is not finite.
double Displacement(const Part& part, const BodyState& state, const WantedPose& wanted);

}  // namespace seam
