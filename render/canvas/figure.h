#pragma once
/// Appearance of a character's parts: rounded, with hair and pelvis in a darker tone, near and far
/// limbs distinct. Nothing is drawn outside the collision shapes.

#include <map>

#include "common/scene/scene.h"
#include "render/canvas/shapes.h"

namespace seam {

/// Returns the character parts of the scene, by part id.
std::map<PartId, FigurePart> FiguresOf(const Scene& scene);

/// Rounds the part's outline, in the frame of the body's root part, and finds its darker area.
/// Requires a part that is a convex polygon.
void ShapeFigure(const Scene& scene, const FigurePart& figure, const Pose& root, Outline* outline);

/// Returns the painting order of a part within its character: far limbs first, the near arm last.
int FigureLayer(const FigurePart& figure);

}  // namespace seam
