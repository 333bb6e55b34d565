#pragma once
/// Joints that couple movements: what [[joint]] says of a gear or a pulley. docs/scenes.md has the
/// equations.

#include "common/scene/scene_draft.h"

namespace seam {

/// Its parts too: the second ones of the joints it couples, which must stand above it. Throws
/// OperatorError.
void ReadGear(const SceneReader& r, const SceneDraft& draft, Joint* joint);

/// Requires the anchors. Throws OperatorError.
void ReadPulley(const SceneReader& r, Joint* joint);

}  // namespace seam
