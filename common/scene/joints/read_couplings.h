#pragma once
/// Reads the joints that couple motions, gear and pulley, from [[joint]]. docs/scenes.md has the
/// equations.

#include "common/scene/scene_draft.h"

namespace seam {

/// Sets the parts too: the second parts of the two coupled joints, which must precede it in the
/// file. Throws OperatorError.
void ReadGear(const SceneReader& r, const SceneDraft& draft, Joint* joint);

/// Requires the anchors. Throws OperatorError.
void ReadPulley(const SceneReader& r, Joint* joint);

}  // namespace seam
