#pragma once
/// Glue that breaks: finds the force through each bond of a body from what acts on its parts.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

/// Whether anything in the scene can break.
bool HasBreakableGlue(const Scene& scene);

/// Forces are means over a tick: a blow of J N s counts as J times the scene's ticks per second.
/// What acts on a part: contacts and joints. Whatever else moves the body (gravity, water, thrust)
/// is taken to act on all of it alike, by mass, and so strains nothing; but gravity on what is
/// anchored does. A body that could not break by the sum of all that acts costs next to nothing.
std::unique_ptr<Stage> MakeGlueStage(const StageWorld& world);

}  // namespace seam
