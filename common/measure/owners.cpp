#include "common/measure/owners.h"

#include "common/scene/ownership.h"

namespace seam {
namespace {

int OwnerOf(const World& world, int body) {
  const Scene& scene = world.scene();
  const Composition& composition = world.composition();
  const int mechanism = world.mechanism(body);
  const int owner = composition.mechanisms[static_cast<std::size_t>(mechanism)].owner;
  if (owner >= 0) return owner;
  const int of_vehicle = VehicleOwner(scene, composition, mechanism);
  if (of_vehicle >= 0) return of_vehicle;
  const Vec2 at = world.Read(body).position;
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    const Player& player = scene.players[p];
    if (!player.has_region) continue;
    const bool inside = (at.array() >= player.region_min.array()).all() &&
                        (at.array() <= player.region_max.array()).all();
    if (inside) return static_cast<int>(p);
  }
  return -1;
}

}  // namespace

std::map<PartId, int> FindOwners(const World& world) {
  std::map<PartId, int> owners;
  for (int body = 0; body < world.body_count(); ++body) {
    const int owner = OwnerOf(world, body);
    if (owner >= 0) owners[world.id(body)] = owner;
  }
  return owners;
}

bool OwnersTouch(const World& world, const std::map<PartId, int>& owners) {
  const auto differ = [&](int a, int b) {
    if (a < 0 || b < 0) return false;
    const auto of_a = owners.find(world.id(a)), of_b = owners.find(world.id(b));
    return of_a != owners.end() && of_b != owners.end() && of_a->second != of_b->second;
  };
  for (const Impact& impact : world.impacts()) {
    if (differ(impact.body_a, impact.body_b)) return true;
  }
  for (const Touch& touch : world.touches()) {
    if (differ(touch.body_a, touch.body_b)) return true;
  }
  return false;
}

}  // namespace seam
