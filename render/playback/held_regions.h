#pragma once
/// Regions of players where authority follows the players: computed from the held bodies.

#include <vector>

#include "render/playback/playback.h"

namespace seam {

/// The box around all bodies under a client's authority in a view, enlarged by kHeldMargin.
struct HeldRegion {
  int peer = 0;
  Vec2 min{0, 0}, max{0, 0};  ///< m
};

/// True if regions follow the held bodies: the mode has regions, and the scene fixes none or
/// overrides them by planner rules (PlannerRules::given).
bool RegionsAreHeld(const Playback& playback);

/// Returns the regions at a moment, by peer, ascending; empty without RegionsAreHeld.
std::vector<HeldRegion> HeldRegions(const Playback& playback, const Moment& moment);

/// Margin around the bodies, m.
constexpr float kHeldMargin = 1;

}  // namespace seam
