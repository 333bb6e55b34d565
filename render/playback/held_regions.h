#pragma once
/// Where authority follows the players: the region of each, as what it holds makes it.

#include <vector>

#include "render/playback/playback.h"

namespace seam {

/// The box around all bodies that a client has authority over in a view, and kHeldMargin more.
struct HeldRegion {
  int peer = 0;
  Vec2 min{0, 0}, max{0, 0};  ///< m
};

/// Whether regions are what the peers hold: the mode has regions, and the scene fixes none.
bool RegionsAreHeld(const Playback& playback);

/// At a moment, by peer, ascending; empty where regions are not held.
std::vector<HeldRegion> HeldRegions(const Playback& playback, const Moment& moment);

/// m beyond the bodies.
constexpr float kHeldMargin = 1;

}  // namespace seam
