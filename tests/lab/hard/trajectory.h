#pragma once
/// Places of a scene's parts at common times, to compare runs at different rates.

#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Returns the number of ticks a second, at `tick_hz`, that fall on multiples of 1/30 s: 30 at
/// 60 Hz, 10 at 50 Hz.
int CommonHz(int tick_hz);

/// The paths of all moving parts, sampled at multiples of 1/30 s from 0 on. Parts, not bodies:
/// welds may be one body in one run and joints in the other.
class Trajectory {
 public:
  explicit Trajectory(const Scene& scene);
  /// Call before the first step and after every tick.
  void See(const World& world);

  std::size_t parts() const { return tracked_.size(); }
  std::size_t samples() const { return samples_.size(); }
  /// Places of all parts at time index/30 s, m; empty where no tick fell on it.
  const std::vector<Eigen::Vector2d>& At(std::size_t index) const { return samples_[index]; }

 private:
  struct Tracked {
    PartId assembly = 0;
    Eigen::Vector2d local{0, 0};  // the part's centre in the assembly's frame, m
  };
  std::vector<Tracked> tracked_;  // the moving parts, ascending
  std::vector<std::vector<Eigen::Vector2d>> samples_;
};

/// RMS distance over all moving parts and the common times after the start, m; infinite when there
/// are none. Requires trajectories of the same parts.
double Distance(const Trajectory& a, const Trajectory& b);

}  // namespace seam
