#pragma once
/// Anchored parts that follow a prescribed path or turn, as a function of time alone: every peer
/// has them in the same pose without any message.

#include <memory>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

class Stage;
struct StageWorld;

/// The scene's prescribed motions, ascending by assembly id.
class ImposedMotions {
 public:
  ImposedMotions(const Scene& scene, const Composition& composition);

  int count() const { return static_cast<int>(motions_.size()); }
  int assembly(int index) const;    ///< index into the composition's
  int IndexOf(int assembly) const;  ///< -1: motionless, or free
  /// Returns the pose and motion of the assembly's root; `tick` may be fractional.
  BodyState At(int index, double tick) const;

 private:
  struct Motion {
    int assembly = 0;
    Eigen::Vector2d pivot{0, 0};        // m, origin of the path and centre of rotation
    Eigen::Vector2d arm{0, 0};          // m, from the pivot to the root's position
    double angle = 0, turning = 0;      // rad, rad/s
    std::vector<Eigen::Vector2d> path;  // m, from the pivot
    std::vector<double> ends;           // m along the path, end of each leg
    double period_s = 1, phase = 0;
    bool ease = false;
  };
  std::vector<Motion> motions_;
  double tick_s_ = 1;
};

/// Makes a stage that moves these parts by their velocities, so that bodies on them are carried
/// along, and sets the exact pose at each tick.
std::unique_ptr<Stage> MakeKinematicStage(const StageWorld& world);

}  // namespace seam
