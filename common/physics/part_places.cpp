#include "common/physics/part_places.h"

#include <cmath>

#include "common/base/check.h"
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
  const int index = AssemblyOf(world, part);
  if (index < 0) return false;
  const Assembly& assembly = world.composition().assemblies[static_cast<std::size_t>(index)];
  const std::vector<Part>& parts = world.scene().parts;
  const Part& own = parts[static_cast<std::size_t>(part)];
  if (assembly.anchored) {
    *state = {own.position, own.angle, {0, 0}, 0};
    return true;
  }
  const Part& root = parts[static_cast<std::size_t>(assembly.id)];
  *state = world.Read(world.BodyOfId(assembly.id));
  const Eigen::Vector2d local = ToRootFrame(own, root, Eigen::Vector2d(0, 0));
  const double angle = static_cast<double>(state->angle);
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::Vector2d arm(c * local.x() - s * local.y(), s * local.x() + c * local.y());
  state->position = (state->position.cast<double>() + arm).cast<float>();
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
  const Vec2 apart = at_b.position - at_a.position;
  const float c = std::cos(at_a.angle), s = std::sin(at_a.angle);
  BondEdit edit;
  edit.a = a;
  edit.b = b;
  edit.position = {c * apart.x() + s * apart.y(), c * apart.y() - s * apart.x()};
  edit.angle = std::remainder(at_b.angle - at_a.angle, 6.2831853f);
  edit.strength = strength;
  return edit;
}

}  // namespace seam
