#pragma once
/// Where a shown body jumps: the corrections that a person sees. No message says that a correction
/// was made; what is drawn says whether it shows.

#include <vector>

#include "render/page/events.h"

namespace seam {

/// A second difference of the shown way against the oracle's of so much is a jump, m.
constexpr double kJump_m = 0.02;

/// Events of kind "correction", the largest of each view and body within a tenth of a second; none
/// without an oracle.
std::vector<PageEvent> FindJumps(const Playback& playback);
/// The same of one peer's view.
std::vector<PageEvent> FindJumpsOf(const Playback& playback, int peer);

}  // namespace seam
