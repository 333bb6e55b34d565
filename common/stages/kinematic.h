#pragma once
/// Anchored parts that are moved: along a path or turning, as a function of time alone, so
/// that every peer has them in the same pose without any message.

#include <memory>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

class Stage;
struct StageWorld;

/// The motions that a scene imposes, ascending by assembly id.
class ImposedMotions {
 public:
  ImposedMotions(const Scene& scene, const Composition& composition);

  int count() const { return static_cast<int>(motions_.size()); }
  int assembly(int index) const;    ///< index into the composition's
  int IndexOf(int assembly) const;  ///< -1: it stands still, or moves freely
  /// Where the assembly's root is, and how it moves; `tick` may lie between ticks.
  BodyState At(int index, double tick) const;

 private:
  struct Motion {
    int assembly = 0;
    Eigen::Vector2d pivot{0, 0};        // m, where the path's origin is; it turns about it
    Eigen::Vector2d arm{0, 0};          // m, from there to the root's position
    double angle = 0, turning = 0;      // rad, rad/s
    std::vector<Eigen::Vector2d> path;  // m, from the pivot
    std::vector<double> ends;           // m along the path, where each leg ends
    double period_s = 1, phase = 0;
    bool ease = false;
  };
  std::vector<Motion> motions_;
  double tick_s_ = 1;
};

/// Moves them by their velocities, so that what lies on them rides, and puts them exactly where
/// they are at each tick.
std::unique_ptr<Stage> MakeKinematicStage(const StageWorld& world);

}  // namespace seam
