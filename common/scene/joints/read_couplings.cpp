#include "common/scene/joints/read_couplings.h"

#include <algorithm>
#include <cmath>

#include "common/base/nearest.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

float ReadRatio(const SceneReader& r, double least) {
  constexpr float kRatioMin = 1e-3f;
  const float ratio = r.Number("ratio", {least, 1000}, 1.0f);
  if (std::fabs(ratio) < kRatioMin) r.FailAt("ratio", "the ratio is too close to 0");
  return ratio;
}

}  // namespace

void ReadGear(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  const std::vector<std::string> names = r.Texts("joints");
  if (names.size() != 2) r.FailAt("joints", "joints must be the names of two joints");
  const std::vector<Joint>& joints = draft.scene.joints;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto named = [&](const Joint& j) { return !j.gone && j.name == names[side]; };
    const auto found = std::find_if(joints.begin(), joints.end(), named);
    if (found == joints.end()) {
      std::vector<std::string> known;
      for (const Joint& other : joints) known.push_back(other.name);
      r.FailAt("joints",
               "there is no joint '" + names[side] + "' above it" + DidYouMean(names[side], known));
    }
    if (found->kind != JointKind::kRevolute && found->kind != JointKind::kPrismatic) {
      r.FailAt("joints", "'" + names[side] + "' is neither a hinge nor prismatic");
    }
    joint->coupled[side] = static_cast<int>(found - joints.begin());
    (side == 0 ? joint->a : joint->b) = found->b;
  }
  joint->ratio = ReadRatio(r, -1000);
  for (const char* key : {"b", "repeat"}) {
    if (r.Has(key)) r.FailAt(key, std::string("a gear joint has no ") + key);
  }
}

void ReadPulley(const SceneReader& r, Joint* joint) {
  constexpr float kRopeMin = 0.1f;  // m; at less, the engine finds no direction of the rope
  joint->ground_a = r.Vector("ground_a", kCoordinate);
  joint->ground_b = r.Vector("ground_b", kCoordinate);
  joint->ratio = ReadRatio(r, 0);
  const float on_a = (joint->anchor_a - joint->ground_a).norm();
  const float on_b = (joint->anchor_b - joint->ground_b).norm();
  for (const auto& [key, length] : {std::pair("ground_a", on_a), std::pair("ground_b", on_b)}) {
    if (length < kRopeMin) r.FailAt(key, "is closer than " + Decimal(double{kRopeMin}) + " m");
  }
  joint->length = r.Number("length", {kEdgeMin, 10000}, on_a + joint->ratio * on_b);
}

}  // namespace seam
