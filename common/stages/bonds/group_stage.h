#pragma once
/// Things that lie still against each other become one body, and several again when something
/// moving comes near.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

/// Whether a bond may be one that resting parts make: of single bodies that no joint holds.
bool MayGroup(const Scene& scene, const Composition& composition, const Edit& bond);

/// Grouped: single bodies (no joint holds them) that have touched and been slower than kRestSpeed
/// and kRestSpin for the scene's time. Undone: when the group moves or feels a change of velocity
/// above the scene's, or the engine's box around a moving body comes to its own, which is before
/// the blow: otherwise the blow would meet one body of all their mass.
std::unique_ptr<Stage> MakeGroupStage(const StageWorld& world);

/// m/s and rad/s: below, a thing rests. The engine's own limits for sleep are 0.01 and 0.035.
constexpr float kRestSpeed = 0.05f, kRestSpin = 0.05f;

}  // namespace seam
