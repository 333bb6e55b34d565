#include "common/physics/stage.h"

#include "common/physics/character_stage.h"
#include "common/physics/feather_stage.h"
#include "common/physics/water_stage.h"

namespace seam {

std::vector<std::unique_ptr<Stage>> MakeStages(const StageWorld& world) {
  // A stage for each feature that the scene uses, and no other.
  std::vector<std::unique_ptr<Stage>> stages;
  if (!world.scene.bricks.empty()) stages.push_back(MakeFeatherStage(world));
  if (!world.scene.waters.empty()) stages.push_back(MakeWaterStage(world));
  if (HasActiveCharacter(world.scene)) stages.push_back(MakeCharacterStage(world));
  return stages;
}

}  // namespace seam
