#include <algorithm>

#include "common/physics/stage.h"
#include "common/scene/bricks.h"
#include "common/scene/character.h"
#include "common/scene/forces.h"
#include "common/scene/grouping.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/water.h"
#include "common/stages/kinematic.h"
#include "common/stages/make_stages.h"
#include "common/topology/join.h"

namespace seam {

bool ProposesEdits(const Scene& scene) {
  const auto grips = [](const Character& c) { return c.active && c.grip; };
  const auto breaks = [](const Joint& joint) { return !joint.gone && IsBreakableGlue(joint); };
  return std::any_of(scene.joints.begin(), scene.joints.end(), breaks) || HasConnectors(scene) ||
         scene.grouping->after > 0 ||
         std::any_of(scene.characters.begin(), scene.characters.end(), grips);
}

std::vector<std::unique_ptr<Stage>> MakeStages(const StageWorld& world) {
  const auto any = [](const auto& all, const auto& uses) {
    return std::any_of(all.begin(), all.end(), uses);
  };
  // What is gone needs none: a saved room does not say what it was.
  const auto any_left = [&](const auto& all, const auto& uses) {
    return any(all, [&](const auto& one) { return !one.gone && uses(one); });
  };
  // One stage for each feature that the scene uses, and no others.
  std::vector<std::unique_ptr<Stage>> stages;
  if (any_left(world.scene.joints,
               [](const Joint& j) { return HoldOf(j.kind) == JointHold::kImposed; })) {
    stages.push_back(MakeKinematicStage(world));
  }
  if (any_left(world.scene.parts, [](const Part& p) { return p.conveyor->speed != 0; })) {
    stages.push_back(MakeConveyorStage(world));
  }
  const auto is_screw = [](const Thrust& t) { return t.screw.diameter > 0; };
  const bool screws = any(world.scene.thrusts, is_screw);
  if (!world.scene.thrusts.empty()) stages.push_back(MakeThrustStage(world));
  if (!world.scene.bricks.empty()) stages.push_back(MakeFeatherStage(world));
  if (!world.scene.waters.empty()) stages.push_back(MakeWaterStage(world));
  if (screws && !world.scene.waters.empty()) {
    stages.push_back(MakePropellerStage(world));
  }
  const bool joins = HasConnectors(world.scene);
  if (joins || any_left(world.scene.joints, IsBreakableGlue))
    stages.push_back(MakeGlueStage(world));
  if (joins) stages.push_back(MakeJoinStage(world));
  if (world.scene.grouping->after > 0) stages.push_back(MakeGroupStage(world));
  if (HasActiveCharacter(world.scene)) stages.push_back(MakeCharacterStage(world));
  if (!world.scene.seats.empty()) {  // last, as they prescribe motion
    stages.push_back(MakeSeatLeaveStage(world));
    stages.push_back(MakeSeatStage(world));
  }
  return stages;
}

}  // namespace seam
