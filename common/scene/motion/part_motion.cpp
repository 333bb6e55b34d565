#include "common/scene/motion/part_motion.h"

#include <algorithm>

#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_reader.h"

namespace seam {
namespace {

constexpr const char* kMotionKeys[] = {"linear_damping", "angular_damping", "gravity_scale",
                                       "fixed_rotation"};

void ReadFilter(const SceneReader& r, CollisionFilter* filter) {
  constexpr Range kFilterBits{0, UINT16_MAX};
  filter->group = r.Integer("group", {-1000, 1000}, 0);
  filter->category =
      static_cast<std::uint16_t>(r.Integer("category", kFilterBits, filter->category));
  filter->mask = static_cast<std::uint16_t>(r.Integer("mask", kFilterBits, filter->mask));
}

}  // namespace

void ReadPartMotion(const SceneReader& r, Part* part) {
  ReadFilter(r, &part->filter);
  const auto key = std::find_if(std::begin(kMotionKeys), std::end(kMotionKeys),
                                [&](const char* name) { return r.Has(name); });
  if (key == std::end(kMotionKeys)) return;
  if (part->anchored) r.FailAt(*key, std::string("an anchored part has no ") + *key);
  PartMotion motion;
  motion.linear_damping = r.Number("linear_damping", kPartDamping, 0.0f);
  motion.angular_damping = r.Number("angular_damping", kPartDamping, 0.0f);
  motion.gravity_scale = r.Number("gravity_scale", kGravityScale, 1.0f);
  motion.fixed_rotation = r.Flag("fixed_rotation", false);
  if (motion.fixed_rotation && part->spin != 0) {
    r.FailAt("spin", "a part with fixed_rotation has no spin");
  }
  part->motion.Set(motion);
}

PartMotion AssemblyMotion(const Scene& scene, const Assembly& assembly) {
  double mass = 0, linear = 0, angular = 0, gravity = 0;
  for (const PartId id : assembly.parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const double own = static_cast<double>(PartMass(part));
    mass += own;
    linear += own * static_cast<double>(part.motion->linear_damping);
    angular += own * static_cast<double>(part.motion->angular_damping);
    gravity += own * static_cast<double>(part.motion->gravity_scale);
  }
  PartMotion motion;
  if (mass <= 0) return motion;
  motion.linear_damping = static_cast<float>(linear / mass);
  motion.angular_damping = static_cast<float>(angular / mass);
  motion.gravity_scale = static_cast<float>(gravity / mass);
  return motion;
}

}  // namespace seam
