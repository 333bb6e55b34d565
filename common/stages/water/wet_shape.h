#pragma once
/// What of an assembly water can touch: its parts' outlines, its outer edges, and the cells of its
/// bounding box. Made once per assembly, in the frame of its root part (the body's).

#include <vector>

#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/stages/water/displaced.h"

namespace seam {

/// The outline of one part: convex corners counter-clockwise, or a disc. A capsule is a polygon of
/// its area, each end in kCapArcs pieces.
struct WetPart {
  bool disc = false, capsule = false;
  std::vector<Vec2d> corners;  ///< m; disc: none
  double radius = 0;           ///< m; disc
  AreaMoments whole;
  double reach = 0;  ///< m: nothing of it is farther from whole.centre
};

/// A piece of the outer edge. `arc`: stands for a piece of a circle, along which the normal turns.
struct WetEdge {
  Vec2d from{0, 0}, to{0, 0};  ///< m; the solid is on the left of the way
  Vec2d normal{0, 1};          ///< unit, outwards
  bool arc = false;
};

struct WetShape {
  std::vector<WetPart> parts;
  std::vector<WetEdge> edges;
  Bounds box;          ///< m; of all parts
  Vec2d centre{0, 0};  ///< m; of the box
  double reach = 0;    ///< m: nothing is farther from the centre
};

/// A circle's edge, and the half circle at a capsule's end, are drawn with so many pieces.
constexpr int kArcs = 24, kCapArcs = 12;

/// Edges of one part that another of the same assembly touches or covers are left out: water does
/// not get there. Parts that overlap displace twice what they share, as they weigh twice there.
WetShape WetShapeOf(const Scene& scene, const Assembly& assembly);

/// The shape cut into n x n cells of its box: what lies in each, row by row, empty ones left out.
struct WetCells {
  std::vector<AreaMoments> pieces;
  Vec2d size{0, 0};  ///< m; width and height of a cell
};
WetCells CellsOf(const WetShape& shape, int n);

}  // namespace seam
