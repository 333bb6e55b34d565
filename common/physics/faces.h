#pragma once
/// Collision shapes of an assembly: merges aligned boxes into few rectangles, so that inner faces
/// cost nothing and bodies do not catch on its seams.

#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Assemblies of fewer parts collide with each part.
constexpr std::size_t kFacesFrom = 8;

struct Face {
  Part shape;                 ///< has the number of its lowest part
  std::vector<PartId> parts;  ///< ascending
};

/// Returns the shapes, ascending by number. Boxes are merged if they have the same angle, friction,
/// restitution and group, and share a whole side, to a millimetre.
std::vector<Face> FacesOf(const Scene& scene, const Assembly& assembly);

/// Finds the box nearest to a point, m, in the boxes' common frame (the scene's poses); the first
/// of several that are equally near.
class NearestOf {
 public:
  /// Requires at least one.
  NearestOf(const Scene& scene, const std::vector<PartId>& parts);
  PartId At(const Eigen::Vector2d& point) const;

 private:
  struct Box {
    Eigen::Vector2d position, half;  // m
    double angle;                    // rad
    PartId id;
  };
  std::vector<Box> boxes_;
};

/// Returns the nearest box for a single point.
inline PartId NearestPart(const Scene& scene, const std::vector<PartId>& parts,
                          const Eigen::Vector2d& point) {
  return NearestOf(scene, parts).At(point);
}

}  // namespace seam
