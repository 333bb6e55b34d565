#pragma once
/// Mechanical energy of a state of a scene, in double precision.

#include <vector>

#include "common/measure/joint_ends.h"
#include "common/scene/mass.h"
#include "common/scene/water.h"
#include "common/stages/water/wet_shape.h"

namespace seam {

/// Computes the mechanical energy of states. Looks up masses, springs and water of the scene once.
class EnergyMeter {
 public:
  EnergyMeter(const Scene& scene, const Composition& composition);

  /// Returns the energy, J: kinetic, potential (0 at the origin's height along gravity), of the
  /// springs of wheel, distance and soft weld joints, and of displaced water. Includes the work of
  /// motors, flows and players; limits and contacts store nothing. `moving`: states of the moving
  /// assemblies, ascending by id; velocities are of the centres of mass. `tick`: places kinematic
  /// parts. Infinite when a state is not finite.
  double Of(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;

 private:
  struct Spring {
    JointEnds ends;
    double stiffness = 0;  // N/m; weld: N m/rad
  };
  double InWater(const std::vector<BodyState>& moving) const;
  double Stretch(const Spring& spring, const std::vector<BodyState>& states) const;

  const FeatureList<Water> waters_;
  std::vector<WetShape> wet_shapes_;    // by moving assembly, if there is water
  Eigen::Vector2d gravity_;             // m/s^2
  std::vector<MassProperties> masses_;  // by moving assembly
  std::vector<Spring> springs_;
  ImposedMotions imposed_;
};

/// Returns EnergyMeter::Of for a single set of states.
inline double MechanicalEnergy(const Scene& scene, const Composition& composition,
                               const std::vector<BodyState>& moving) {
  return EnergyMeter(scene, composition).Of(moving);
}

}  // namespace seam
