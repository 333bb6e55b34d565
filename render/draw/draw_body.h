#pragma once
/// One body on a panel: filled, hatched and outlined by authority and role, or as the dashed ghost
/// of the oracle.

#include "render/canvas/viewport.h"
#include "render/playback/playback.h"

namespace seam {

/// Style of a body.
struct BodyLook {
  Colour fill;
  Colour edge;
  bool hatched = false;  ///< stripes of the edge's colour over the fill
  float opacity = 1;
};

/// Returns the style for a role. Authority: the peer's colour. Secondary: lighter. Remote: pale and
/// hatched.
BodyLook LookOf(Colour base, int role);
/// Returns the style of anchored ground.
BodyLook GroundLook();

void DrawBody(DrawList& list, const Viewport& viewport, const BodyShapes& body, const Pose& pose,
              const BodyLook& look);

/// Draws a dashed outline, `width` px, with a pale rim, so that it is visible on any fill.
void DrawGhost(DrawList& list, const Viewport& viewport, const BodyShapes& body, const Pose& pose,
               float opacity, float width = 1.3f);

/// Draws an impact: a ring of `radius` px with eight rays that extend `reach` px beyond it.
void DrawSpark(DrawList& list, const Vec2& at, float radius, float reach, const Line& line);

/// Returns the largest distance on the panel between the same point of a body's outline in two
/// poses, px.
float PixelsApart(const Viewport& viewport, const BodyShapes& body, const Pose& a, const Pose& b);

}  // namespace seam
