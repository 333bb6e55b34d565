#pragma once
/// The outline of convex polygons that touch or overlap: the stretches of their sides that
/// something outside can reach, and how the outline goes on at both ends of each.
///
///        c______b ______a          The sides between two tiles are inside, so that the outline
///        |      |       |          has neither: b-c goes on as a-b did.
///        |______|_______|

#include <Eigen/Core>
#include <vector>

namespace seam {

/// A convex polygon with its points counter-clockwise, m.
struct SolidPolygon {
  std::vector<Eigen::Vector2d> points;
  /// Collision group, as of parts: below 0, members do not collide with each other. So a member
  /// hides a side only from other members of its group.
  int group = 0;
};

/// A stretch of a polygon's side, from `from` to `to` counter-clockwise, m.
struct OutlineEdge {
  Eigen::Vector2d from{0, 0}, to{0, 0};
  Eigen::Vector2d before{0, 0}, after{0, 0};  ///< unit directions of the outline at the ends
};

struct SolidOutline {
  /// True if nothing hides any of its sides or continues them: the polygon stands alone.
  bool alone = true;
  std::vector<OutlineEdge> edges;  ///< if not alone; none if all of it is inside
};

/// Returns the outline of each polygon. Polygons less than `gap` (m, above 2 mm) apart touch. At a
/// joint of two polygons their edges are prolonged to meet. Steps lower than half a centimetre are
/// not seen: the engine's rims are wider.
std::vector<SolidOutline> OutlinesOf(const std::vector<SolidPolygon>& polygons, double gap);

}  // namespace seam
