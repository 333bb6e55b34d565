/// Adds a piece of a scene while the room runs, with the same reader and the same checks.

#include "common/base/check.h"
#include "common/scene/crowding/crowding.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_text.h"
#include "common/topology/topology.h"

namespace seam {
namespace {

/// Checks that need the composition, for the parts and joints from `parts` and `joints` on.
void CheckTogether(const SceneReader& root, const Scene& scene, const std::string& file,
                   std::size_t parts, std::size_t joints) {
  const Composition composition = Compose(scene);
  const auto assembly_of = [&](std::size_t part) {
    return static_cast<std::size_t>(composition.assembly_of_part[part]);
  };
  std::vector<bool> grown(composition.assemblies.size(), false);  // by assembly
  for (std::size_t p = parts; p < scene.parts.size(); ++p) grown[assembly_of(p)] = true;
  for (std::size_t j = joints; j < scene.joints.size(); ++j) {
    grown[assembly_of(static_cast<std::size_t>(scene.joints[j].a))] = true;
    grown[assembly_of(static_cast<std::size_t>(scene.joints[j].b))] = true;
  }
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    const Part& part = scene.parts[p];
    if (part.gone || !grown[assembly_of(p)]) continue;
    const Assembly& assembly = composition.assemblies[assembly_of(p)];
    const Part& first = scene.parts[static_cast<std::size_t>(assembly.id)];
    const float most = p < parts ? 2 * kWeldReachMax : kWeldReachMax;
    if ((part.position - first.position).norm() > most) {
      root.Fail("part '" + part.name + "': is welded over more than " + Decimal(most) + " m");
    }
  }
  for (std::size_t j = joints; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    const bool rigid = IsRigid(joint, scene.solver) || HoldOf(joint.kind) == JointHold::kImposed;
    const bool same = assembly_of(static_cast<std::size_t>(joint.a)) ==
                      assembly_of(static_cast<std::size_t>(joint.b));
    if (!rigid && same) root.Fail("joint '" + joint.name + "': its parts are welded together");
  }
  CheckCrowding(scene, composition, file, static_cast<PartId>(parts));
}

}  // namespace

void AddToScene(const std::string& text, Scene* scene, bool whole) {
  const std::string file = "insert";
  CheckSceneText(text, file);
  const TomlNode tree = ParseToml(text, file);
  SceneDraft draft{file, *scene, kSizeMaxDefault};
  for (const Part& part : draft.scene.parts) {
    if (!part.gone) draft.part_of_name[part.name] = part.id;
  }
  for (const Joint& joint : draft.scene.joints) {
    if (!joint.gone) draft.joint_names.insert(joint.name);
  }
  const std::size_t parts = draft.scene.parts.size(), joints = draft.scene.joints.size();
  const SceneReader root(tree, file, "insert", {"part", "joint"});
  if (!root.Has("part") && !root.Has("joint")) root.Fail("needs a [[part]] or a [[joint]]");
  if (root.Has("part")) ReadParts(root, &draft);
  ReadJoints(root, &draft);
  if (draft.scene.parts.size() > kPartsEver) root.Fail("there have been too many parts");
  if (draft.scene.joints.size() > kJointsEver) root.Fail("there have been too many joints");
  if (whole) CheckTogether(root, draft.scene, file, parts, joints);
  *scene = std::move(draft.scene);
}

}  // namespace seam
