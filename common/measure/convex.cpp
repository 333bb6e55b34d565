#include "common/measure/convex.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seam {
namespace {

using Eigen::Vector2d;

/// Returns the unit normal on the right of the direction from `a` to `b`: outwards for
/// counter-clockwise corners.
Vector2d RightOf(const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  return Vector2d(along.y(), -along.x()) / along.norm();
}

/// Returns the greatest separation of `b`'s corners from a face of `a`; negative: no face separates
/// them. Ignores radii. Stops at the first separating face.
double BeyondFaces(const Convex& a, const Convex& b) {
  double most = -kFar;
  for (int i = 0; i < a.count; ++i) {
    const Vector2d& corner = a.corners[i];
    const Vector2d normal = RightOf(corner, a.corners[(i + 1) % a.count]);
    double least = kFar;
    for (int k = 0; k < b.count; ++k) least = std::min(least, normal.dot(b.corners[k] - corner));
    most = std::max(most, least);
    if (most >= 0) return most;
  }
  return most;
}

/// Returns the parameter of the point nearest to `p` on the line: 0 at `a`, 1 at `b`; not clamped.
double Along(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  return (p - a).dot(b - a) / (b - a).squaredNorm();
}

Vector2d NearestOf(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  return a + std::clamp(Along(a, b, p), 0.0, 1.0) * (b - a);
}

/// Returns the least distance of a corner of `b` from an edge of `a`.
double CornersFromEdges(const Convex& a, const Convex& b) {
  double nearest = kFar;
  for (int i = 0; i < a.count; ++i) {
    const Vector2d& next = a.corners[(i + 1) % a.count];
    for (int k = 0; k < b.count; ++k) {
      const Vector2d& p = b.corners[k];
      nearest = std::min(nearest, (p - NearestOf(a.corners[i], next, p)).norm());
    }
  }
  return nearest;
}

/// The distance of a point from the nearest edge, negative on the solid side.
struct Height {
  double squared = kFar;  // m^2
  double side = 1;        // its sign
  bool beyond = true;     // past the end of the line: open

  void Consider(const TerrainEdge& edge, const Vector2d& p) {
    const Vector2d away = p - NearestOf(edge.from, edge.to, p);
    if (away.squaredNorm() >= squared) return;
    squared = away.squaredNorm();
    const double along = Along(edge.from, edge.to, p);
    // At a corner the sum of the two edges' normals decides the side.
    Vector2d normal = edge.normal;
    if (along <= 0) normal += edge.normal_before;
    if (along >= 1) normal += edge.normal_after;
    side = normal.dot(away);
    beyond =
        (along < 0 && edge.normal_before.isZero(0)) || (along > 1 && edge.normal_after.isZero(0));
  }
  double value() const { return side < 0 ? -std::sqrt(squared) : std::sqrt(squared); }
};

}  // namespace

double OverlapDepth(const Convex& a, const Convex& b) {
  if (a.count == 1 && b.count == 1) {
    return std::max(0.0, a.radius + b.radius - (a.corners[0] - b.corners[0]).norm());
  }
  // Either the hulls of the corners overlap, or the radii exceed the distance of the hulls.
  double beyond = a.count > 1 ? BeyondFaces(a, b) : -kFar;
  if (beyond < 0 && b.count > 1) beyond = std::max(beyond, BeyondFaces(b, a));
  const double rims = a.radius + b.radius;
  if (beyond < 0) return rims - beyond;
  if (beyond >= rims) return 0;
  double apart = kFar;
  if (a.count > 1) apart = std::min(apart, CornersFromEdges(a, b));
  if (b.count > 1) apart = std::min(apart, CornersFromEdges(b, a));
  return std::max(0.0, rims - apart);
}

std::vector<TerrainEdge> TerrainEdges(const std::vector<Eigen::Vector2d>& line) {
  std::vector<TerrainEdge> edges(line.size() - 1);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i].from = line[i];
    edges[i].to = line[i + 1];
    edges[i].normal = -RightOf(line[i], line[i + 1]);
    if (i == 0) continue;
    edges[i].normal_before = edges[i - 1].normal;
    edges[i - 1].normal_after = edges[i].normal;
  }
  return edges;
}

double DepthInTerrain(const Convex& solid, const std::vector<const TerrainEdge*>& edges) {
  double cut = 0, deepest = 0, shallowest = kFar;
  bool all_below = true;
  for (const TerrainEdge* edge : edges) {
    if (solid.count == 1) break;  // a circle's depth is its centre's height, below
    const Eigen::Vector2d ends[] = {edge->from, edge->to};
    cut = std::max(cut, OverlapDepth(solid, {ends, 2, 0}));
  }
  for (int i = 0; i < solid.count; ++i) {
    Height height;
    for (const TerrainEdge* edge : edges) height.Consider(*edge, solid.corners[i]);
    if (height.beyond) {
      all_below = false;
      continue;
    }
    const double below = solid.radius - height.value();  // of its lowest point
    deepest = std::max(deepest, below);
    shallowest = std::min(shallowest, below - 2 * solid.radius);
    all_below = all_below && below > 0;
  }
  const bool counts = cut > 0 || (all_below && shallowest <= kTerrainReach);
  return counts ? std::max(cut, deepest) : cut;
}

}  // namespace seam
