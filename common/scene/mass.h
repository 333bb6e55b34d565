#pragma once
/// Mass, centre and moment of inertia of parts and assemblies, in double precision.

#include "common/scene/assembly.h"

namespace seam {

/// Least share of a body's moment of inertia about its position, of mass times distance of the
/// centre squared: single precision keeps 1e-7.
constexpr double kInertiaLeft = 1e-4;

struct MassProperties {
  double mass = 0;               ///< kg
  Eigen::Vector2d centre{0, 0};  ///< m, in the frame named by the function
  double inertia = 0;            ///< kg m^2, about the centre
};

/// Returns the properties in the part's own frame; all zero for anchored lines. Moving lines
/// have the mass of a strip of kLineWidth.
MassProperties PartProperties(const Part& part);

/// Returns the properties in the frame of the assembly's root part.
MassProperties AssemblyProperties(const Scene& scene, const Assembly& assembly);

/// Converts a point of `part`'s frame to `root`'s frame, m.
Eigen::Vector2d ToRootFrame(const Part& part, const Part& root, const Eigen::Vector2d& point);

}  // namespace seam
