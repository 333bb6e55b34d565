#pragma once
/// Faces of parts that look up: what something may lie on.

#include <cstdint>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// A face from the left to the right, in whole mm: straight, or the upper half of a circle.
struct Floor {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< its ends; x0 < x1
  std::int64_t radius = 0;                      ///< of a circle's, its centre between its ends

  struct Heights {
    std::int64_t low = 0, high = 0;
  };
  /// mm: how low and how high it is between two places. Requires x0 <= from <= to <= x1. Integers,
  /// and a square root, which IEEE 754 rounds alike everywhere.
  Heights Between(std::int64_t from, std::int64_t to) const;
};

/// The faces of a part as the scene puts it that look up: the upper sides of what has an inside,
/// chains where they are solid below, segments. Upright ones are none.
std::vector<Floor> FloorsOf(const Part& part);

}  // namespace seam
