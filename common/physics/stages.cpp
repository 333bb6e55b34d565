#include "common/physics/stage.h"

namespace seam {

std::vector<std::unique_ptr<Stage>> MakeStages(const StageWorld& /*world*/) {
  // A stage for each feature that the scene uses, and no other:
  //   if (!world.scene.waters.empty()) stages.push_back(MakeWaterStage(world));
  std::vector<std::unique_ptr<Stage>> stages;
  return stages;
}

}  // namespace seam
