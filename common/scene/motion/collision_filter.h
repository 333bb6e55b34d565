#pragma once
/// Decides by number which parts may collide, as Box2D's b2Filter does.

#include <cstdint>

namespace seam {

struct CollisionFilter {
  int group = 0;                    ///< -1000..1000; 0: none
  std::uint16_t category = 1;       ///< bits of the categories that the part belongs to
  std::uint16_t mask = UINT16_MAX;  ///< bits of the categories that it collides with
};

/// Parts of the same group, not 0, collide if it is positive and never if it is negative. All
/// others collide if each one's mask has a bit of the other's category.
inline bool MayCollide(const CollisionFilter& a, const CollisionFilter& b) {
  if (a.group == b.group && a.group != 0) return a.group > 0;
  return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

}  // namespace seam
