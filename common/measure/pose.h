#pragma once
/// The pose of an assembly in double precision: its root part's frame in the world.

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "common/base/geometry.h"
#include "common/scene/assembly.h"

namespace seam {

/// A frame in the world: a rotation, then a shift.
struct RootFrame {
  Eigen::Vector2d position{0, 0};  ///< m
  Rotation<double> rotation;

  RootFrame() = default;
  RootFrame(const Vec2& at, float angle) : position(at.cast<double>()), rotation(double{angle}) {}
  explicit RootFrame(const BodyState& state) : RootFrame(state.position, state.angle) {}
  explicit RootFrame(const Part& root) : RootFrame(root.position, root.angle) {}

  Eigen::Vector2d ToWorld(const Eigen::Vector2d& local) const { return position + rotation(local); }
  Eigen::Vector2d ToLocal(const Eigen::Vector2d& p) const { return rotation.Back(p - position); }
};

inline bool IsFinite(const BodyState& state) {
  return state.position.allFinite() && state.velocity.allFinite() && std::isfinite(state.angle) &&
         std::isfinite(state.spin);
}

/// Returns, for each of composition.assemblies, its index among the moving assemblies (ascending by
/// id, as World numbers bodies), or -1 if it is anchored.
inline std::vector<int> MovingIndices(const Composition& composition) {
  std::vector<int> indices;
  int next = 0;
  for (const Assembly& assembly : composition.assemblies) {
    indices.push_back(assembly.anchored ? -1 : next++);
  }
  return indices;
}

}  // namespace seam
