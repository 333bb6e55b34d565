#pragma once
/// Visible corrections: jumps of displayed bodies. No message reports a correction, so jumps are
/// found in the displayed poses.

#include <vector>

#include "render/page/events.h"

namespace seam {

/// Least second difference of the displayed path less the oracle's that is a jump, m.
constexpr double kJump_m = 0.02;

/// Returns events of kind "correction", the largest of each view and body within a tenth of a
/// second; none without an oracle.
std::vector<PageEvent> FindJumps(const Playback& playback);
/// Returns the corrections of one peer's view.
std::vector<PageEvent> FindJumpsOf(const Playback& playback, int peer);

}  // namespace seam
