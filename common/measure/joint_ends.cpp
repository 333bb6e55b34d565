#include "common/measure/joint_ends.h"

namespace seam {

std::vector<JointEnds> FindJointEnds(const Scene& scene, const Composition& composition) {
  const std::vector<int> moving = MovingIndices(composition);
  const auto end = [&](PartId part, const Vec2& anchor, const Vec2& axis) {
    JointEnd e;
    e.assembly = composition.assembly_of_part[static_cast<std::size_t>(part)];
    e.moving = moving[static_cast<std::size_t>(e.assembly)];
    e.point = anchor.cast<double>();
    e.axis = axis.cast<double>().normalized();
    if (e.moving < 0) return e;
    const PartId root = composition.assemblies[static_cast<std::size_t>(e.assembly)].id;
    const Pose pose(scene.parts[static_cast<std::size_t>(root)]);
    e.point = pose.ToLocal(e.point);
    e.axis = pose.TurnBack(e.axis);
    return e;
  };
  std::vector<JointEnds> all;
  for (const Joint& joint : scene.joints) {
    if (joint.gone || joint.kind == JointKind::kGlue) continue;
    if (joint.kind == JointKind::kWeld && !scene.solver.weld_joints) continue;
    JointEnds ends;
    ends.kind = joint.kind;
    ends.a = end(joint.a, joint.anchor_a, joint.axis);
    ends.b = end(joint.b, joint.anchor_b, joint.axis);
    if (ends.a.assembly == ends.b.assembly) continue;
    ends.length = joint.length > 0
                      ? double{joint.length}
                      : (joint.anchor_b - joint.anchor_a).cast<double>().norm();
    ends.frequency_hz = double{joint.frequency_hz};
    all.push_back(ends);
  }
  return all;
}

}  // namespace seam
