#pragma once
/// The boundary of a cell's bricks as few long chains: touching bricks have no edge between them.

#include <vector>

#include "common/topology/feather_store.h"

namespace seam {

/// Directions along the axes; left of `d` is d + 1, right of it d + 3, modulo 4.
enum Heading { kEast, kNorth, kWest, kSouth };

/// A piece of the boundary with solid on the left and air on the right of the way.
struct OutlinePath {
  struct Corner {
    int x = 0, y = 0;                       ///< units
    Heading before = kEast, after = kEast;  ///< the boundary's way before and behind it
  };
  std::vector<Corner> corners;
  /// Returns to its first corner. Otherwise it begins and ends at the cell's border, or where the
  /// surface changes, and its end corners' headings are those of its continuation there.
  bool closed = false;
  int surface = 0;  ///< BrickKind::surface
};

/// The boundary of all bricks as far as it belongs to solid within the cell. What the paths of all
/// cells say together is the boundary of the union of all bricks, each edge once. A function of
/// which bricks there are, in a fixed order.
///
///      cell | cell          The top is one line. Each cell has its half of it; both know that it
///     ______|______         goes straight on: what slides over the border does not feel it.
///     [][][]|[][][]
std::vector<OutlinePath> OutlinesOf(const FeatherStore& store, int cell_x, int cell_y);

}  // namespace seam
