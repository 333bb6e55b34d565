#pragma once
/// Mass, centre and moment of inertia of parts and assemblies, in double precision.

#include "common/scene/assembly.h"

namespace seam {

struct MassProperties {
  double mass = 0;               ///< kg
  Eigen::Vector2d centre{0, 0};  ///< m, in the frame that was asked for
  double inertia = 0;            ///< kg m^2, about the centre
};

/// In the part's own frame. All zero for lines.
MassProperties PartProperties(const Part& part);

/// In the frame of the assembly's root part.
MassProperties AssemblyProperties(const Scene& scene, const Assembly& assembly);

/// A point of `part`'s frame in `root`'s frame, m.
Eigen::Vector2d ToRootFrame(const Part& part, const Part& root, const Eigen::Vector2d& point);

}  // namespace seam
