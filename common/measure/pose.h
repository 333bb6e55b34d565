#pragma once
/// Where an assembly is, in double precision: its root part's frame in the world.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// A frame in the world: a turn, then a shift.
struct Pose {
  Eigen::Vector2d position{0, 0};  ///< m
  double c = 1, s = 0;             ///< cosine and sine of the angle

  Pose() = default;
  Pose(const Vec2& at, float angle)
      : position(at.cast<double>()), c(std::cos(double{angle})), s(std::sin(double{angle})) {}
  explicit Pose(const BodyState& state) : Pose(state.position, state.angle) {}
  explicit Pose(const Part& root) : Pose(root.position, root.angle) {}

  Eigen::Vector2d Turn(const Eigen::Vector2d& p) const {
    return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
  }
  Eigen::Vector2d ToWorld(const Eigen::Vector2d& local) const { return position + Turn(local); }
  Eigen::Vector2d TurnBack(const Eigen::Vector2d& p) const {
    return {c * p.x() + s * p.y(), c * p.y() - s * p.x()};
  }
  Eigen::Vector2d ToLocal(const Eigen::Vector2d& p) const { return TurnBack(p - position); }
};

inline bool IsFinite(const BodyState& state) {
  return state.position.allFinite() && state.velocity.allFinite() && std::isfinite(state.angle) &&
         std::isfinite(state.spin);
}

/// By index into composition.assemblies: the place among the moving ones (ascending by id, as
/// World counts bodies), or -1 for an anchored one.
inline std::vector<int> MovingIndices(const Composition& composition) {
  std::vector<int> indices;
  int next = 0;
  for (const Assembly& assembly : composition.assemblies) {
    indices.push_back(assembly.anchored ? -1 : next++);
  }
  return indices;
}

}  // namespace seam
