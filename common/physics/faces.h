#pragma once
/// The shapes that an assembly collides with: few rectangles instead of many aligned boxes, so that
/// inner faces cost nothing and bodies do not catch at its seams.

#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Assemblies of fewer parts collide with each of them.
constexpr std::size_t kFacesFrom = 8;

struct Face {
  Part shape;                 ///< with the number of the lowest of its parts
  std::vector<PartId> parts;  ///< ascending
};

/// Ascending by number. Boxes become one when they have the same angle, friction, restitution and
/// group, and share a whole side, to a millimetre.
std::vector<Face> FacesOf(const Scene& scene, const Assembly& assembly);

/// Which of some boxes is the nearest to a point of their common frame (the scene's poses), m; of
/// several the first.
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

/// The same for one point.
inline PartId NearestPart(const Scene& scene, const std::vector<PartId>& parts,
                          const Eigen::Vector2d& point) {
  return NearestOf(scene, parts).At(point);
}

}  // namespace seam
