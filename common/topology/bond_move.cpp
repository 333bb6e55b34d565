#include "common/topology/bond_move.h"

#include <cmath>

#include "common/scene/scene_limits.h"
#include "common/topology/topology.h"

namespace seam {
namespace {

/// Largest distance of a part from its body's root after a bond, m: shapes far from their body's
/// origin lose their edges to rounding.
constexpr float kBondReachMax = 2 * kWeldReachMax;

}  // namespace

BondMove MoveOf(const Scene& scene, const Composition& composition, const BondEdit& bond) {
  const Part& a = scene.parts[static_cast<std::size_t>(bond.a)];
  const Part& b = scene.parts[static_cast<std::size_t>(bond.b)];
  const int assembly_a = composition.assembly_of_part[static_cast<std::size_t>(bond.a)];
  const int assembly_b = composition.assembly_of_part[static_cast<std::size_t>(bond.b)];
  const bool move_a = composition.assemblies[static_cast<std::size_t>(assembly_b)].anchored;
  const Transform2 apart{bond.position.cast<double>(), static_cast<double>(bond.angle)};
  const Transform2 wanted_b = PlaceOf(a).Then(apart);
  const Transform2 b_moves = wanted_b.Then(PlaceOf(b).Inverse());
  return {move_a ? assembly_a : assembly_b, move_a ? b_moves.Inverse() : b_moves};
}

bool FitsTogether(const Scene& scene, const Composition& composition, const BondEdit& bond) {
  const BondMove move = MoveOf(scene, composition, bond);
  const auto part_of = [&](PartId id) -> const Part& {
    return scene.parts[static_cast<std::size_t>(id)];
  };
  const auto assembly_of = [&](PartId part) -> const Assembly& {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(part)];
    return composition.assemblies[static_cast<std::size_t>(index)];
  };
  const auto place_of = [&](PartId id) {
    const bool moved = composition.assembly_of_part[static_cast<std::size_t>(id)] == move.assembly;
    return moved ? move.moves.Then(PlaceOf(part_of(id))) : PlaceOf(part_of(id));
  };
  const PartId roots[] = {assembly_of(bond.a).id, assembly_of(bond.b).id};
  const float masses[] = {PartMass(part_of(roots[0])), PartMass(part_of(roots[1]))};
  const bool same = masses[0] == masses[1];
  const bool first = same ? roots[0] < roots[1] : masses[0] > masses[1];
  const Eigen::Vector2d root = place_of(first ? roots[0] : roots[1]).shift;
  for (const PartId end : {bond.a, bond.b}) {
    for (const PartId id : assembly_of(end).parts) {
      const Transform2 place = place_of(id);
      const bool near = (place.shift - root).norm() <= static_cast<double>(kBondReachMax) &&
                        place.shift.cwiseAbs().maxCoeff() <= static_cast<double>(kPlaceMax) &&
                        std::fabs(place.angle) <= static_cast<double>(kTurnMax);
      if (!near) return false;
    }
  }
  return true;
}

}  // namespace seam
