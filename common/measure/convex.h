#pragma once
/// Overlap depth of two convex solids: exact geometry in double precision, without the physics
/// engine's contact skin and tolerances.

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace seam {

/// Distance beyond all distances, m.
constexpr double kFar = std::numeric_limits<double>::infinity();

/// A convex solid with borrowed corners: one corner and a radius is a circle, two corners are a
/// segment (with a radius a capsule), three or more a polygon, counter-clockwise.
struct Convex {
  const Eigen::Vector2d* corners = nullptr;  ///< m
  int count = 0;
  double radius = 0;  ///< m, around the corners' hull
};

/// Returns the penetration depth, m: the least distance by which one solid has to move to separate
/// the two (separating axes: Ericson, Real-Time Collision Detection, 5.2). 0 without an overlap.
double OverlapDepth(const Convex& a, const Convex& b);

/// One edge of terrain: solid on the right of the direction from `from` to `to`.
struct TerrainEdge {
  Eigen::Vector2d from{0, 0}, to{0, 0};  ///< m
  /// Unit normals into the open: of this edge and of its neighbours; zero where the line ends.
  Eigen::Vector2d normal{0, 1}, normal_before{0, 0}, normal_after{0, 0};
};

/// Returns the edges of a terrain line. Requires at least two points.
std::vector<TerrainEdge> TerrainEdges(const std::vector<Eigen::Vector2d>& line);

/// A solid that is wholly below terrain counts as overlapping down to this depth, m. A deeper one
/// may rightly be there, for example under a bridge, since terrain is open from below.
constexpr double kTerrainReach = 0.5;

/// Returns the depth of a circle or polygon in terrain, m: the greatest distance from the nearest
/// edge over its points on the solid side, or the depth at which an edge cuts it. Space beyond the
/// ends of a line is open. `edges`: at least all edges within kTerrainReach of the solid.
double DepthInTerrain(const Convex& solid, const std::vector<const TerrainEdge*>& edges);

}  // namespace seam
