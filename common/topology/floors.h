#pragma once
/// Upward faces of parts, on which something may lie.

#include <cstdint>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// A face from left to right, in whole mm: straight, or the upper half of a circle.
struct Floor {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< its ends; x0 < x1
  std::int64_t radius = 0;                      ///< of a circle centred between the ends, or 0

  struct Heights {
    std::int64_t low = 0, high = 0;
  };
  /// Returns the lowest and the highest point between two coordinates, mm. Requires x0 <= from <=
  /// to <= x1. Integers and one square root, which IEEE 754 rounds alike everywhere.
  Heights Between(std::int64_t from, std::int64_t to) const;
};

/// Returns the upward faces of a part at its pose in the scene: upper sides of solid shapes, chains
/// where they are solid below, segments. Vertical faces are left out.
std::vector<Floor> FloorsOf(const Part& part);

}  // namespace seam
