#pragma once
/// Conveyors and thrust at work.

#include "common/physics/stage.h"

namespace seam {

/// Gives the contacts of parts with a conveyor their tangent speed: friction does the rest, and is
/// the most that a belt can pull with.
std::unique_ptr<Stage> MakeConveyorStage(const StageWorld& world);

/// Pushes bodies before each of the engine's steps. What sleeps is woken when a player's command
/// changes, and by nothing else.
std::unique_ptr<Stage> MakeThrustStage(const StageWorld& world);

}  // namespace seam
