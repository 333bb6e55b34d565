#include "common/physics/carried_along.h"

#include <map>

#include "common/base/geometry.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

using Eigen::Vector2d;

int AssemblyIndex(const PlacedBodies& at, PartId part) {
  const auto p = static_cast<std::size_t>(part);
  return p < at.composition.assembly_of_part.size() ? at.composition.assembly_of_part[p] : -1;
}

const Assembly& AssemblyAt(const PlacedBodies& at, int index) {
  return at.composition.assemblies[static_cast<std::size_t>(index)];
}

/// Returns the mechanism of a moving part; -1 if it is anchored, or gone.
int MechanismOf(const PlacedBodies& at, PartId part) {
  const int index = AssemblyIndex(at, part);
  return index < 0 || AssemblyAt(at, index).anchored ? -1 : AssemblyAt(at, index).mechanism;
}

Transform2 PoseOf(const BodyState& state) {
  return {state.position.cast<double>(), static_cast<double>(state.angle)};
}

/// Returns the pose of a part. Requires one that is not gone.
Transform2 PlaceNow(const PlacedBodies& at, const std::vector<int>& bodies, PartId id) {
  const int index = AssemblyIndex(at, id);
  const Part& part = at.parts[static_cast<std::size_t>(id)];
  const int body = bodies[static_cast<std::size_t>(index)];
  if (body < 0) return {part.position.cast<double>(), static_cast<double>(part.angle)};
  const Part& root = at.parts[static_cast<std::size_t>(AssemblyAt(at, index).id)];
  return PoseOf(at.states[static_cast<std::size_t>(body)])
      .Then({ToRootFrame(part, root, Vector2d(0, 0)),
             static_cast<double>(part.angle) - static_cast<double>(root.angle)});
}

}  // namespace

std::vector<BodyState> CarriedAlong(const PlacedBodies& before, const PlacedBodies& now) {
  const std::vector<int> bodies_before = BodyOfAssembly(before.composition);
  const std::vector<int> bodies_now = BodyOfAssembly(now.composition);
  std::map<int, Transform2> moves;  // by mechanism before
  for (const Assembly& a : now.composition.assemblies) {
    const int staying = a.anchored ? -1 : MechanismOf(before, a.id);
    for (const PartId part : a.parts) {
      const int mechanism = MechanismOf(before, part);
      if (mechanism < 0 || mechanism == staying || moves.count(mechanism) > 0) continue;
      moves[mechanism] =
          PlaceNow(now, bodies_now, part).Then(PlaceNow(before, bodies_before, part).Inverse());
    }
  }
  std::vector<BodyState> jumps;
  if (moves.empty()) return jumps;
  bool any = false;
  for (const Assembly& a : now.composition.assemblies) {
    if (a.anchored) continue;
    const BodyState& lies = now.states[jumps.size()];
    BodyState& jump = jumps.emplace_back();
    const auto move = moves.find(MechanismOf(before, a.id));
    const int then = AssemblyIndex(before, a.id);
    if (move == moves.end() || AssemblyAt(before, then).parts != a.parts) continue;
    const Vector2d from = lies.position.cast<double>();
    jump.position = (move->second(from) - from).cast<float>();
    jump.angle = static_cast<float>(move->second.angle);
    any = true;
  }
  if (!any) jumps.clear();
  return jumps;
}

}  // namespace seam
