#include "common/measure/joint_ends.h"

#include <algorithm>

#include "common/scene/joint_kinds.h"

namespace seam {

std::vector<BodyState> AllStates(const std::vector<BodyState>& moving,
                                 const ImposedMotions& imposed, std::int64_t tick) {
  std::vector<BodyState> all = moving;
  for (int i = 0; i < imposed.count(); ++i) {
    all.push_back(imposed.At(i, static_cast<double>(tick)));
  }
  return all;
}

std::vector<JointEnds> FindJointEnds(const Scene& scene, const Composition& composition) {
  std::vector<int> moving = MovingIndices(composition);
  int next = 0;
  for (const int index : moving) next = std::max(next, index + 1);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (composition.assemblies[i].kinematic >= 0) moving[i] = next++;  // as AllStates counts
  }
  const auto end = [&](PartId part, const Vec2& anchor, const Vec2& axis) {
    JointEnd e;
    e.assembly = composition.assembly_of_part[static_cast<std::size_t>(part)];
    e.moving = moving[static_cast<std::size_t>(e.assembly)];
    e.point = anchor.cast<double>();
    e.axis = axis.cast<double>().normalized();
    if (e.moving < 0) return e;
    const PartId root = composition.assemblies[static_cast<std::size_t>(e.assembly)].id;
    const RootFrame frame(scene.parts[static_cast<std::size_t>(root)]);
    e.point = frame.ToLocal(e.point);
    e.axis = frame.rotation.Back(e.axis);
    return e;
  };
  std::vector<JointEnds> all;
  std::vector<int> listed(scene.joints.size(), -1);  // by joint: index in `all`
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (joint.gone || IsRigid(joint, scene.solver)) continue;
    JointEnds ends;
    if (HoldOf(joint.kind) == JointHold::kCoupled) {
      const int first = listed[static_cast<std::size_t>(joint.coupled[0])];
      const int second = listed[static_cast<std::size_t>(joint.coupled[1])];
      if (first < 0 || second < 0) continue;
      ends.coupled = {static_cast<std::size_t>(first), static_cast<std::size_t>(second)};
    }
    ends.kind = joint.kind;
    ends.a = end(joint.a, joint.anchor_a, joint.axis);
    ends.b = end(joint.b, joint.anchor_b, joint.axis);
    if (ends.a.assembly == ends.b.assembly) continue;
    ends.length = joint.length > 0 ? double{joint.length}
                                   : (joint.anchor_b - joint.anchor_a).cast<double>().norm();
    ends.frequency_hz = double{joint.frequency_hz};
    // An anchored end has the angle 0.
    const auto angle = [&](const JointEnd& e) {
      const PartId root = composition.assemblies[static_cast<std::size_t>(e.assembly)].id;
      return e.moving < 0 ? 0 : double{scene.parts[static_cast<std::size_t>(root)].angle};
    };
    ends.angle = angle(ends.b) - angle(ends.a);
    ends.limited = joint.limited;
    ends.lower = double{joint.lower};
    ends.upper = double{joint.upper};
    ends.turn = double{joint.turn};
    ends.ratio = double{joint.ratio};
    ends.ground_a = joint.ground_a.cast<double>();
    ends.ground_b = joint.ground_b.cast<double>();
    listed[j] = static_cast<int>(all.size());
    all.push_back(ends);
  }
  return all;
}

}  // namespace seam
