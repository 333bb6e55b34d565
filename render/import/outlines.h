#pragma once
/// The shapes of a scene that an imported shape becomes.

#include <string>
#include <vector>

#include "common/base/geometry.h"
#include "common/scene/scene.h"
#include "render/import/imported.h"

namespace seam {

struct PieceOutline {
  ShapeKind kind = ShapeKind::kPolygon;  ///< not a capsule
  Transform2 pose;                       ///< in the body's frame
  Eigen::Vector2d size{0, 0};            ///< box: m
  double radius = 0;                     ///< circle: m
  std::vector<Eigen::Vector2d> points;   ///< of the others: m, in its own frame
  bool walled = false;                   ///< a chain for an outline wider than a shape may be
  double extent = 0;                     ///< m, along x or y of its frame, the larger
};

/// Returns a rectangle as a box, other convex outlines as a polygon, a concave one as a closed
/// chain or, if it `moves`, as triangles (ear clipping), one wider than kSizeMaxMax as a chain, and
/// a line with two sides as two chains or, if it `moves`, as segments.
/// Points closer than kEdgeMin are left out. Empty if nothing of the least size remains.
std::vector<PieceOutline> PiecesOf(const ImportedShape& shape, bool moves);

/// Returns the key of the shape in a scene, a line.
std::string ShapeText(const PieceOutline& piece);

}  // namespace seam
