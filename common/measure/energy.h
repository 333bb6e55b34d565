#pragma once
/// Mechanical energy of a state of a scene, in double precision.

#include <vector>

#include "common/measure/joint_ends.h"
#include "common/scene/mass.h"
#include "common/scene/water.h"
#include "common/stages/water/wet_shape.h"

namespace seam {

/// Everything about a scene's energy that its states do not change, looked up once.
class EnergyMeter {
 public:
  EnergyMeter(const Scene& scene, const Composition& composition);

  /// J: kinetic, potential (0 at the origin's height along gravity), in springs of wheel, distance
  /// and soft weld joints, and in the water that things push aside. What motors, flows and players
  /// put in is in it; limits and contacts store nothing. `moving`: of the moving assemblies
  /// ascending by id; velocities are of the centres of mass. `tick`: where kinematic parts are.
  /// Infinite when a state is not finite.
  double Of(const std::vector<BodyState>& moving, std::int64_t tick = 0) const;

 private:
  struct Spring {
    JointEnds ends;
    double stiffness = 0;  // N/m; of a weld: N m/rad
  };
  double InWater(const std::vector<BodyState>& moving) const;
  double Stretch(const Spring& spring, const std::vector<BodyState>& states) const;

  const FeatureList<Water> waters_;
  std::vector<WetShape> wet_shapes_;    // of the moving assemblies, if there is water
  Eigen::Vector2d gravity_;             // m/s^2
  std::vector<MassProperties> masses_;  // of the moving assemblies
  std::vector<Spring> springs_;
  ImposedMotions imposed_;
};

/// The same, for one state.
inline double MechanicalEnergy(const Scene& scene, const Composition& composition,
                               const std::vector<BodyState>& moving) {
  return EnergyMeter(scene, composition).Of(moving);
}

}  // namespace seam
