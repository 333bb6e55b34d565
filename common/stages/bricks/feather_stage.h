#pragma once
/// Gives bricks fixtures where something moves, and takes them away again.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

/// Requires world.scene.bricks. Which cells have fixtures is a function of where the bodies are and
/// were since the world was last built; nothing that touches or could touch within a tick is ever
/// missing.
std::unique_ptr<Stage> MakeFeatherStage(const StageWorld& world);

}  // namespace seam
