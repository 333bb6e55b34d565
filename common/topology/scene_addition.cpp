/// A piece of a scene that is added while the room runs: the same reader, the same checks.

#include "common/base/check.h"
#include "common/scene/crowding.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/scene_text.h"
#include "common/topology/topology.h"

namespace seam {

void AddToScene(const std::string& text, Scene* scene) {
  const std::string file = "insert";
  CheckSceneText(text, file);
  const TomlNode tree = ParseToml(text, file);
  SceneDraft draft{file, *scene, kSizeMaxDefault, {}, {}};
  for (const Part& part : draft.scene.parts) {
    if (!part.gone) draft.part_of_name[part.name] = part.id;
  }
  const std::size_t parts = draft.scene.parts.size(), joints = draft.scene.joints.size();
  const SceneReader root(tree, file, "insert", {"part", "joint"});
  if (!root.Has("part") && !root.Has("joint")) root.Fail("needs a [[part]] or a [[joint]]");
  if (root.Has("part")) ReadParts(root, &draft);
  ReadJoints(root, &draft);
  if (draft.scene.parts.size() > kPartsEver) root.Fail("there are too many parts");
  const Composition composition = Compose(draft.scene);
  for (std::size_t p = parts; p < draft.scene.parts.size(); ++p) {
    const Part& part = draft.scene.parts[p];
    const int index = composition.assembly_of_part[p];
    const Assembly& assembly = composition.assemblies[static_cast<std::size_t>(index)];
    const Part& first = draft.scene.parts[static_cast<std::size_t>(assembly.id)];
    if ((part.position - first.position).norm() > kWeldReachMax) {
      root.Fail("part '" + part.name + "': is welded over more than " + Decimal(kWeldReachMax) +
                " m");
    }
  }
  for (std::size_t j = joints; j < draft.scene.joints.size(); ++j) {
    const Joint& joint = draft.scene.joints[j];
    const bool rigid =
        IsRigid(joint, draft.scene.solver) || HoldOf(joint.kind) == JointHold::kImposed;
    const int a = composition.assembly_of_part[static_cast<std::size_t>(joint.a)];
    const int b = composition.assembly_of_part[static_cast<std::size_t>(joint.b)];
    if (!rigid && a == b) root.Fail("joint '" + joint.name + "': its parts are welded together");
  }
  CheckCrowding(draft.scene, composition, file, static_cast<PartId>(parts));
  *scene = std::move(draft.scene);
}

}  // namespace seam
