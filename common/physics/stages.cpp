#include <algorithm>

#include "common/physics/feather_stage.h"
#include "common/physics/kinematic.h"
#include "common/physics/stage.h"
#include "common/physics/water_stage.h"

namespace seam {

std::vector<std::unique_ptr<Stage>> MakeStages(const StageWorld& world) {
  const auto any = [](const auto& all, const auto& uses) {
    return std::any_of(all.begin(), all.end(), uses);
  };
  // A stage for each feature that the scene uses, and no other.
  std::vector<std::unique_ptr<Stage>> stages;
  if (any(world.scene.joints, [](const Joint& j) { return j.kind == JointKind::kKinematic; })) {
    stages.push_back(MakeKinematicStage(world));
  }
  if (!world.scene.bricks.empty()) stages.push_back(MakeFeatherStage(world));
  if (!world.scene.waters.empty()) stages.push_back(MakeWaterStage(world));
  return stages;
}

}  // namespace seam
