#include "common/sync/reach/driven.h"

#include <algorithm>

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

void Drivers::Find() {
  const Scene& scene = world_.scene();
  const auto players = static_cast<int>(scene.players.size());
  driven_.assign(scene.players.size(), {});
  belts_.assign(scene.players.size(), 0);
  by_axes_.assign(world_.composition().mechanisms.size(), 0);
  const auto player_of = [&](int driver) {
    if (driver < players) return driver;
    return scene.seats[static_cast<std::size_t>(driver - players)].player;
  };
  const auto add = [&](int player, int mechanism) {
    if (player < 0 || mechanism < 0) return;
    driven_[static_cast<std::size_t>(player)].push_back(mechanism);
    by_axes_[static_cast<std::size_t>(mechanism)] = 1;
  };
  const auto add_part = [&](int driver, PartId part) {
    if (driver >= 0 && part >= 0) add(player_of(driver), MechanismOf(world_, part));
  };
  const std::vector<Mechanism>& mechanisms = world_.composition().mechanisms;
  for (std::size_t m = 0; m < mechanisms.size(); ++m) add(mechanisms[m].owner, static_cast<int>(m));
  for (int p = 0; p < players; ++p) {
    const Player& self = scene.players[static_cast<std::size_t>(p)];
    add_part(p, self.vehicle);
    for (const Action& action : self.actions) {
      const int m = MechanismOf(world_, action.part);
      if (m >= 0) driven_[static_cast<std::size_t>(p)].push_back(m);
    }
  }
  for (const Joint& joint : scene.joints) {
    if (joint.gone || joint.motor_player < 0) continue;
    add_part(joint.motor_player, joint.a);
    add_part(joint.motor_player, joint.b);
  }
  for (const Thrust& thrust : scene.thrusts) add_part(thrust.player, thrust.part);
  for (const Character& character : scene.characters) {
    add_part(character.player, character.parts[kTorso]);
  }
  for (const Part& part : scene.parts) {
    if (part.conveyor->player < 0) continue;
    const int player = player_of(part.conveyor->player);
    if (player >= 0) belts_[static_cast<std::size_t>(player)] = 1;
  }
  for (std::vector<int>& all : driven_) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
}

void Drivers::Look() {
  if (revision_ != world_.topology().revision()) Find();
  revision_ = world_.topology().revision();
  concerns_.assign(driven_.size(), 0);
  for (std::size_t p = 0; p < driven_.size(); ++p) {
    const bool here =
        Moves(static_cast<int>(p), [this](int m) { return roles_.RoleOf(m) != kRoleRemote; });
    concerns_[p] = here ? 1 : 0;
  }
}

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
