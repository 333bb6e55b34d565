#pragma once
/// Traces the boundary of a cell's bricks as few long chains: touching bricks have no edge between
/// them.

#include <vector>

#include "common/topology/feather_store.h"

namespace seam {

/// Directions along the axes; left of `d` is d + 1, right of it d + 3, modulo 4.
enum Heading { kEast, kNorth, kWest, kSouth };

/// A piece of the boundary, with solid on the left of its direction and air on the right.
struct OutlinePath {
  struct Corner {
    int x = 0, y = 0;                       ///< units
    Heading before = kEast, after = kEast;  ///< boundary's direction before and after the corner
  };
  std::vector<Corner> corners;
  /// True if the path returns to its first corner. Otherwise it begins and ends at the cell's
  /// border or at a change of surface, and its end corners' headings are those of the continuation
  /// there.
  bool closed = false;
  int surface = 0;  ///< BrickKind::surface
};

/// Returns the boundary of all bricks as far as its solid side lies within the cell. Together, the
/// paths of all cells are the boundary of the union of all bricks, each edge once. Depends only on
/// the present bricks; in a fixed order.
///
///      cell | cell          The top is one line. Each cell has its half of it; both know that it
///     ______|______         goes straight on: a body that slides over the border feels nothing.
///     [][][]|[][][]
std::vector<OutlinePath> OutlinesOf(const FeatherStore& store, int cell_x, int cell_y);

}  // namespace seam
