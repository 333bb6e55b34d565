#include "common/physics/part_places.h"

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

/// The index of a part's assembly; -1 when it is gone.
int AssemblyOf(const World& world, PartId part) {
  const std::vector<int>& all = world.composition().assembly_of_part;
  if (part < 0 || static_cast<std::size_t>(part) >= all.size()) return -1;
  return all[static_cast<std::size_t>(part)];
}

}  // namespace

bool ReadPart(const World& world, PartId part, BodyState* state) {
  return ReadPart(
      world, part, [&world](int body) { return world.Read(body); }, state);
}

bool ReadPart(const World& world, PartId part, const std::function<BodyState(int body)>& read,
              BodyState* state) {
  const int index = AssemblyOf(world, part);
  if (index < 0) return false;
  const Assembly& assembly = world.composition().assemblies[static_cast<std::size_t>(index)];
  const std::vector<Part>& parts = world.scene().parts;
  const Part& own = parts[static_cast<std::size_t>(part)];
  if (assembly.anchored && assembly.kinematic < 0) {
    *state = {own.position, own.angle, {0, 0}, 0};
    return true;
  }
  const Part& root = parts[static_cast<std::size_t>(assembly.id)];
  *state = assembly.anchored ? world.ReadAssembly(index) : read(world.BodyOfId(assembly.id));
  const Eigen::Vector2d local = ToRootFrame(own, root, Eigen::Vector2d(0, 0));
  const Transform2 placed{state->position.cast<double>(), static_cast<double>(state->angle)};
  state->position = placed(local).cast<float>();
  state->angle += own.angle - root.angle;
  return true;
}

BodyState PartPose(const World& world, PartId part) {
  BodyState state;
  const bool there = ReadPart(world, part, &state);
  SEAM_ASSERT(there);
  return state;
}

int MechanismOf(const World& world, PartId part) {
  const int index = AssemblyOf(world, part);
  return index < 0 ? -1 : world.composition().assemblies[static_cast<std::size_t>(index)].mechanism;
}

BondEdit BondAsTheyAre(const World& world, PartId a, PartId b, float strength) {
  const BodyState at_a = PartPose(world, a), at_b = PartPose(world, b);
  BondEdit edit;
  edit.a = a;
  edit.b = b;
  edit.position = Rotation<float>(at_a.angle).Back(at_b.position - at_a.position);
  edit.angle = WrapAngle(at_b.angle - at_a.angle);
  edit.strength = strength;
  return edit;
}

}  // namespace seam
