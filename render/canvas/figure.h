#pragma once
/// How a character's parts look: rounded, with hair and pelvis in a darker tone, near and far limbs
/// apart. Nothing is drawn outside of the shapes that the engine has.

#include <map>

#include "common/scene/scene.h"
#include "render/canvas/shapes.h"

namespace seam {

/// Of all characters of the scene, by part.
std::map<PartId, FigurePart> FiguresOf(const Scene& scene);

/// Rounds the part's outline, in the frame of the body's root part, and finds its darker share.
/// Requires that the part is a convex polygon.
void ShapeFigure(const Scene& scene, const FigurePart& figure, const Pose& root, Outline* outline);

/// Where a character's part is painted among the others of the same one: the far limbs first, the
/// near arm last.
int FigureLayer(const FigurePart& figure);

}  // namespace seam
