#pragma once
/// Finds where anchored parts are many and close together: rows and walls of tiles.

#include <cstddef>
#include <vector>

#include "common/scene/assembly.h"

namespace seam {

/// Number of anchored parts, touching each other and near, from which they are dense.
constexpr std::size_t kDenseFrom = 32;

/// Returns, by assembly, true if it is anchored, does not move, and belongs to a row of kDenseFrom
/// parts or more that touch each other. Only what fits into a square of 16 m joins a row: a ground
/// does not make one row of what stands on it far apart. Other parts of the scene make no
/// difference.
std::vector<bool> DenseAnchored(const Scene& scene, const Composition& composition);

/// Column and row of a square of the plane.
struct AnchoredSquare {
  int column = 0, row = 0;
};
inline bool operator<(const AnchoredSquare& a, const AnchoredSquare& b) {
  return a.column != b.column ? a.column < b.column : a.row < b.row;
}
inline bool operator==(const AnchoredSquare& a, const AnchoredSquare& b) {
  return a.column == b.column && a.row == b.row;
}

/// Side of the squares, m. In each step the engine walks through the contacts of the later body of
/// a pair, so a body must not have the contacts of a whole city.
constexpr float kAnchoredSquare = 16;

/// Returns the square that an assembly's root lies in.
AnchoredSquare SquareOf(const Part& root);

}  // namespace seam
