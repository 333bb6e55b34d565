#pragma once
/// The world as one peer shows it at a moment: ground, trails, bodies, ghosts, impacts.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// What of it, and when.
struct WorldLook {
  int peer = 0;          ///< whose view
  double tick = 0;       ///< may lie between ticks
  bool cull = true;      ///< leave out what the panel does not show; changes no pixel
  bool trails = true;    ///< where each body was shown at each tick: one dot a tick
  bool ghosts = true;    ///< where the oracle has it, if elsewhere
  bool vectors = false;  ///< from where the oracle has it to where it is shown
  bool heat = false;     ///< fill by that distance instead of by authority
  bool pale = false;     ///< bodies are only the ground for a difference
  bool names = false;    ///< of all bodies, not only of the players' vehicles
};

/// What a playback's scene wants to be seen at a tick: the scene's box, or as large a box about the
/// part that its camera follows (on the oracle's path if there is one, so that the camera does not
/// stutter with the view).
Viewport SceneViewport(const Rect& panel, const Playback& playback, int peer, double tick);

/// Draws into viewport.panel and nowhere else.
void DrawWorld(DrawList& list, const Viewport& viewport, const Playback& playback,
               const WorldLook& look);

}  // namespace seam
