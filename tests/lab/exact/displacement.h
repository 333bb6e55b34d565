#pragma once
/// Distance of a part from its wanted pose.

#include <Eigen/Core>
#include <optional>

#include "common/scene/scene.h"

namespace seam {

/// Wanted pose of a part's frame; an unset value may be anything.
struct WantedPose {
  std::optional<double> x, y;   ///< m
  std::optional<double> angle;  ///< rad; whole turns do not matter
};

/// Returns the largest distance of a point of the part's shape from its place in the wanted pose,
/// m: exact for all shapes. Unset values count as right: with x and y alone it is the distance of
/// the part's centre. NaN if the state is not finite.
double Displacement(const Part& part, const BodyState& state, const WantedPose& wanted);

}  // namespace seam
