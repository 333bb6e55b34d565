#pragma once
/// The scenery of a panel: grid, players' regions with their buffer zones, ground, scale bar, and
/// water: a tint behind everything that moves, a thinner one over it, and the level as a line.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Draws the panel's background, a grid of 1, 2 or 5 times ten to the n metres, and the players'
/// regions in their peers' colours with the band of scene.buffer_m around each, if the mode has
/// regions. Where authority follows the players, the regions are those of HeldRegions, without a
/// band. Call first on a panel.
void DrawRegions(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment);
/// Returns the height that DrawRegionLines needs, px; 0: the scene fixes no regions.
float RegionLinesHeight(const Playback& playback, float scale);
/// Draws the horizontal extents of regions (thick) and of their buffer zones (thin), a line each,
/// below the panel from `y` px down, so that nothing of the world is covered.
void DrawRegionLines(DrawList& list, const Viewport& viewport, const Playback& playback, float y);

/// Draws all anchored bodies, and kinematic parts at `tick`. `revision`: of that moment.
void DrawGround(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, double tick, bool cull);

/// Returns the area that DrawScaleBar draws into.
Rect ScaleBarArea(const DrawList& list, const Viewport& viewport);
/// Draws a bar of a round number of metres in the lower right corner.
void DrawScaleBar(DrawList& list, const Viewport& viewport);

/// Draws the water, and its flow as arrows. Call before drawing the bodies.
void DrawWaters(DrawList& list, const Viewport& viewport, const Playback& playback);
/// Draws a tint over bodies under water, and the water level. Call after drawing the bodies.
void DrawSurfaces(DrawList& list, const Viewport& viewport, const Playback& playback);

}  // namespace seam
