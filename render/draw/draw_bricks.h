#pragma once
/// A scene's bricks on a panel: only visible ones, with a detail that depends on the scale.

#include "common/topology/feather_store.h"
#include "render/canvas/viewport.h"

namespace seam {

/// A rectangle filled by bricks of one kind, units of 5 cm.
struct BrickBlock {
  int x = 0, y = 0, columns = 0, rows = 0, kind = 0;
};

/// Returns the bricks of a cell as few blocks: merges neighbours to rows, then stacked equal rows.
std::vector<BrickBlock> BlocksOf(const FeatherStore& store, int cell);

/// Draws cells of a few pixels as a shade by their density, larger cells as outlined blocks, and
/// near cells with the joints between bricks.
void DrawBricks(DrawList& list, const Viewport& viewport, const FeatherStore& store);

}  // namespace seam
