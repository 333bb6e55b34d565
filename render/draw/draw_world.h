#pragma once
/// The world in one peer's view at a moment: ground, trails, bodies, ghosts, impacts.

#include <vector>

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// The displayed view, moment and layers.
struct WorldLook {
  int peer = 0;          ///< the peer of the view
  double tick = 0;       ///< may lie between ticks
  bool cull = true;      ///< skip bodies outside the panel; changes no pixel
  bool trails = true;    ///< earlier displayed positions of each mechanism, one dot a tick
  bool parts = false;    ///< trails of all bodies, not only of each mechanism's heaviest
  bool ghosts = true;    ///< the oracle's poses, where they differ from the view's
  bool vectors = false;  ///< arrows from the oracle's to the displayed positions
  bool divergence = false;  ///< rings about bodies that differed from what their authority told
  bool doubts = false;      ///< rings about bodies of which the server doubted a state
  bool heat = false;     ///< fill by the distance from the oracle instead of by authority
  bool pale = false;     ///< pale bodies, as the background of a difference
  bool names = false;    ///< names of all bodies, not only of the players' vehicles
  std::vector<Rect> texts = {};  ///< areas of the panel with texts that no name may cover, px
};

/// Returns the view of the scene's own camera at a tick: the scene's box, or a box of the same size
/// about the followed part (on the oracle's path if there is one, so that the camera does not
/// stutter with the view).
Viewport SceneViewport(const Rect& panel, const Playback& playback, int peer, double tick);

/// Draws into viewport.panel and nowhere else.
void DrawWorld(DrawList& list, const Viewport& viewport, const Playback& playback,
               const WorldLook& look);

}  // namespace seam
