#pragma once
/// The stage that lets a scene's active characters act.

#include <memory>

#include "common/physics/stage.h"

namespace seam {

bool HasActiveCharacter(const Scene& scene);
/// Requires an active character in the scene.
std::unique_ptr<Stage> MakeCharacterStage(const StageWorld& world);

}  // namespace seam
