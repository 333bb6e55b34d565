#pragma once
/// The same scene far from the origin, where single precision is coarse.

#include "tests/lab/hard/invariant_watch.h"

namespace seam {

/// Moves everything in the scene: parts, joints, bounds, camera. Players' regions stay.
void ShiftScene(const Vec2& by, Scene* scene);

/// Error: the farthest, m, that any body is from where the same body is in the same scene at the
/// origin, stepped beside it with the same solver. Requires a scene that is as its text says but
/// for its solver and for having been moved by `by`. Fails with "fell" when a body is farther than
/// `away_m` from where it began.
std::unique_ptr<Judge> MakeFarJudge(const WatchLimits& limits, double away_m, const Vec2& by);

}  // namespace seam
