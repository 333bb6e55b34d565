#include "common/sync/reach/driven.h"

#include "common/physics/part_places.h"
#include "common/scene/character.h"
#include "common/scene/forces.h"

namespace seam {
namespace {

/// Whether inputs of `driver`, a player or a seat, are those of `player` now.
bool Follows(const Scene& scene, int driver, int player) {
  if (driver < 0) return false;
  const auto players = static_cast<int>(scene.players.size());
  if (driver < players) return driver == player;
  return scene.seats[static_cast<std::size_t>(driver - players)].player == player;
}

}  // namespace

std::vector<bool> DrivenMechanisms(const World& world, int player, bool actions) {
  const Scene& scene = world.scene();
  const std::vector<Mechanism>& mechanisms = world.composition().mechanisms;
  std::vector<bool> driven(mechanisms.size(), false);
  for (std::size_t m = 0; m < mechanisms.size(); ++m) driven[m] = mechanisms[m].owner == player;
  const auto add = [&](PartId part) {
    const int m = part < 0 ? -1 : MechanismOf(world, part);
    if (m >= 0) driven[static_cast<std::size_t>(m)] = true;
  };
  const Player& self = scene.players[static_cast<std::size_t>(player)];
  add(self.vehicle);
  for (const Joint& joint : scene.joints) {
    if (joint.gone || !Follows(scene, joint.motor_player, player)) continue;
    add(joint.a);
    add(joint.b);
  }
  for (const Thrust& thrust : scene.thrusts) {
    if (Follows(scene, thrust.player, player)) add(thrust.part);
  }
  for (const Character& character : scene.characters) {
    if (Follows(scene, character.player, player)) add(character.parts[kTorso]);
  }
  for (std::size_t a = 0; actions && a < self.actions.size(); ++a) add(self.actions[a].part);
  return driven;
}

}  // namespace seam
