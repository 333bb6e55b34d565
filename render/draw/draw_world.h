#pragma once
/// The world as one peer shows it at a moment: ground, trails, bodies, ghosts, impacts.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// What of it, and when.
struct WorldLook {
  int peer = 0;      ///< whose view
  double tick = 0;   ///< may lie between ticks
  bool cull = true;  ///< leave out what the panel does not show; changes no pixel
  bool trails = true;
};

/// What a playback's scene wants to be seen at a tick: the scene's box, or as large a box about the
/// part that its camera follows (on the oracle's path if there is one, so that the camera does not
/// stutter with the view).
Viewport SceneViewport(const Rect& panel, const Playback& playback, int peer, double tick);

/// Draws into viewport.panel and nowhere else.
void DrawWorld(DrawList& list, const Viewport& viewport, const Playback& playback,
               const WorldLook& look);

}  // namespace seam
