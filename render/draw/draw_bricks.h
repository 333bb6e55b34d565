#pragma once
/// A scene's bricks on a panel: only what is seen, in as much detail as can be seen.

#include "common/topology/feather_store.h"
#include "render/canvas/viewport.h"

namespace seam {

/// Bricks of one kind that fill a rectangle, units of 5 cm.
struct BrickBlock {
  int x = 0, y = 0, columns = 0, rows = 0, kind = 0;
};

/// The bricks of a cell in few blocks: rows of neighbours, then equal rows one on the other.
std::vector<BrickBlock> BlocksOf(const FeatherStore& store, int cell);

/// Cells of a few pixels are shaded by how full they are; larger ones are drawn by blocks with the
/// bricks' outline around them, and near ones with the joints between bricks.
void DrawBricks(DrawList& list, const Viewport& viewport, const FeatherStore& store);

}  // namespace seam
