#include "common/measure/limit/driven.h"

#include "common/physics/part_places.h"
#include "common/scene/character.h"

namespace seam {

std::vector<bool> DrivenBy(const World& world, int player) {
  const Scene& scene = world.scene();
  const std::vector<Mechanism>& mechanisms = world.composition().mechanisms;
  std::vector<bool> driven(mechanisms.size(), false);
  for (std::size_t m = 0; m < mechanisms.size(); ++m) driven[m] = mechanisms[m].owner == player;
  const auto add = [&](PartId part) {
    const int m = part < 0 ? -1 : MechanismOf(world, part);
    if (m >= 0) driven[static_cast<std::size_t>(m)] = true;
  };
  add(scene.players[static_cast<std::size_t>(player)].vehicle);
  for (const Character& character : scene.characters) {
    for (const PartId part : character.parts) add(character.player == player ? part : -1);
  }
  for (const Seat& seat : scene.seats) add(seat.player == player ? seat.part : -1);
  std::vector<bool> own;
  for (int body = 0; body < world.body_count(); ++body) {
    own.push_back(driven[static_cast<std::size_t>(world.mechanism(body))]);
  }
  return own;
}

}  // namespace seam
