#pragma once
/// The part of an assembly that water can touch: its parts' outlines, its outer edges, and the
/// cells of its bounding box. Computed once per assembly, in the frame of its root part (the
/// body's).

#include <vector>

#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/stages/water/displaced.h"

namespace seam {

/// The outline of one part: convex corners counter-clockwise, or a disc. A capsule is a polygon of
/// equal area, with kCapArcs pieces at each end.
struct WetPart {
  bool disc = false, capsule = false;
  std::vector<Vec2d> corners;  ///< m; disc: none
  double radius = 0;           ///< m; disc
  AreaMoments whole;
  double reach = 0;  ///< m: largest distance from whole.centre
};

/// A piece of the outer edge. `arc`: represents a piece of a circle, along which the normal turns.
struct WetEdge {
  Vec2d from{0, 0}, to{0, 0};  ///< m; the solid is on the left of the direction
  Vec2d normal{0, 1};          ///< unit, outwards
  bool arc = false;
};

struct WetShape {
  std::vector<WetPart> parts;
  std::vector<WetEdge> edges;
  Bounds box;          ///< m; bounding box of all parts
  Vec2d centre{0, 0};  ///< m; centre of the box
  double reach = 0;    ///< m: largest distance from the centre
};

/// Number of pieces of a circle's edge, and of the half circle at a capsule's end.
constexpr int kArcs = 24, kCapArcs = 12;

/// Builds the shape. Edges of one part that another part of the assembly touches or covers are left
/// out: water does not get there. Overlapping parts displace their intersection twice, as they also
/// weigh twice there.
WetShape WetShapeOf(const Scene& scene, const Assembly& assembly);

/// Pieces of the shape in n x n cells of its box, row by row, empty ones left out.
struct WetCells {
  std::vector<AreaMoments> pieces;
  Vec2d size{0, 0};  ///< m; width and height of a cell
};
WetCells CellsOf(const WetShape& shape, int n);

}  // namespace seam
