#pragma once
/// The colour of a peer in a recording: its player's colour in the scene, or the palette's.

#include "render/canvas/palette.h"
#include "render/playback/playback.h"

namespace seam {

Colour ColourOf(const Playback& playback, int peer);

}  // namespace seam
