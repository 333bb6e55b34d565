#pragma once
/// What stands still on a panel: grid, players' regions with their buffer zones, ground, scale bar,
/// and water: a tint behind everything that moves, a thinner one over it, and the level as a line.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Comes first on a panel: its ground, a grid of 1, 2 or 5 times ten to the n metres, and the
/// players' regions in their peers' colours, and the band of scene.buffer_m around each, if the
/// mode has them; where authority follows the players what each holds at the moment, without a
/// band.
void DrawRegions(DrawList& list, const Viewport& viewport, const Playback& playback,
                 const Moment& moment);
/// How much room DrawRegionLines needs, px; 0: the scene fixes no regions.
float RegionLinesHeight(const Playback& playback, float scale);
/// The extents of regions (thick) and of their buffer zones (thin), a line each, below the panel
/// from `y` px down: nothing of the world is covered.
void DrawRegionLines(DrawList& list, const Viewport& viewport, const Playback& playback, float y);

/// All that is anchored, kinematic parts where they are at `tick`. `revision`: of that moment.
void DrawGround(DrawList& list, const Viewport& viewport, const Playback& playback,
                const DrawnRevision& revision, double tick, bool cull);

/// A bar of a round number of metres in the lower right corner.
void DrawScaleBar(DrawList& list, const Viewport& viewport);

/// Before the bodies: the water, and its flow as arrows.
void DrawWaters(DrawList& list, const Viewport& viewport, const Playback& playback);
/// After the bodies: the veil over what is under water, and the level.
void DrawSurfaces(DrawList& list, const Viewport& viewport, const Playback& playback);

}  // namespace seam
