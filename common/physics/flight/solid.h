#pragma once
/// Collision tests for bodies that are not simulated.

#include <box2d/box2d.h>

namespace seam {

inline bool IsSolidAndAnchored(const b2Fixture& fixture) {
  return fixture.GetBody()->GetType() == b2_staticBody && !fixture.IsSensor();
}

/// True if their filters let them collide, as in the engine.
inline bool Collide(const b2Fixture& a, const b2Fixture& b) {
  const b2Filter &ours = a.GetFilterData(), &theirs = b.GetFilterData();
  if (ours.groupIndex == theirs.groupIndex && ours.groupIndex != 0) return ours.groupIndex > 0;
  return (ours.maskBits & theirs.categoryBits) != 0 && (ours.categoryBits & theirs.maskBits) != 0;
}

}  // namespace seam
