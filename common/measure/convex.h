#pragma once
/// How deep two convex solids overlap: exact geometry in double precision, without the physics
/// engine's rims and tolerances.

#include <Eigen/Core>
#include <vector>

namespace seam {

/// Corners somewhere else: one corner and a radius is a circle, two corners are a segment, with a
/// radius a capsule, three or more a polygon, counter-clockwise.
struct Convex {
  const Eigen::Vector2d* corners = nullptr;  ///< m
  int count = 0;
  double radius = 0;  ///< m, around the corners' hull
};

/// The least distance by which one has to move for the two to touch no more, m (separating axes:
/// Ericson, Real-Time Collision Detection, 5.2). 0 when they do not overlap.
double OverlapDepth(const Convex& a, const Convex& b);

/// One piece of terrain: solid on the right of the way from `from` to `to`.
struct TerrainEdge {
  Eigen::Vector2d from{0, 0}, to{0, 0};  ///< m
  /// Unit, into the open; that of the neighbours, zero where the line ends.
  Eigen::Vector2d normal{0, 1}, normal_before{0, 0}, normal_after{0, 0};
};

/// The pieces of a line of at least two points.
std::vector<TerrainEdge> TerrainEdges(const std::vector<Eigen::Vector2d>& line);

/// A solid wholly below terrain counts as far as this below it: deeper, it may be where it should
/// be, under a bridge, since terrain is open from below. m
constexpr double kTerrainReach = 0.5;

/// How deep a circle or polygon is in terrain, m: the greatest distance of a point of it from the
/// nearest edge, if that point is on the solid side, or the depth at which an edge cuts it. Beyond
/// the ends of a line is open. `edges`: at least those within kTerrainReach of the solid.
double DepthInTerrain(const Convex& solid, const std::vector<const TerrainEdge*>& edges);

}  // namespace seam
