#pragma once
/// How a part moves apart from forces: damping, its share of gravity, fixed rotation.

#include "common/scene/assembly.h"
#include "common/scene/scene.h"

namespace seam {

class SceneReader;

struct PartMotion {
  float linear_damping = 0;   ///< 1/s; a step of h s divides the velocity by 1 + h * damping
  float angular_damping = 0;  ///< 1/s; the same for the spin
  float gravity_scale = 1;    ///< times the scene's gravity
  bool fixed_rotation = false;
};

/// Moment of inertia of a part with fixed rotation, kg m^2. No torque turns it: the largest impulse
/// of a scene (1e9 N s at 1 km) changes its spin by 1e-18 rad/s. Single precision holds 3e38.
constexpr double kFixedInertia = 1e30;

/// Returns the mass-weighted mean of the parts' values; fixed rotation is part of the inertia
/// (mass.h). The default if all parts have the default.
PartMotion AssemblyMotion(const Scene& scene, const Assembly& assembly);

/// Reads the keys linear_damping, angular_damping, gravity_scale and fixed_rotation into `part`,
/// and group, category and mask. Throws OperatorError.
void ReadPartMotion(const SceneReader& r, Part* part);

}  // namespace seam
