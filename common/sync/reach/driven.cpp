#include "common/sync/reach/driven.h"

#include <algorithm>

#include "common/physics/part_places.h"
#include "common/scene/character.h"
#include "common/scene/forces.h"

namespace seam {
namespace {

/// Returns the player behind `driver` (a player, or a seat), or -1 for an empty seat.
int PlayerOf(const Scene& scene, int driver) {
  const auto players = static_cast<int>(scene.players.size());
  if (driver < players) return driver;
  return scene.seats[static_cast<std::size_t>(driver - players)].player;
}

/// Calls `visit(player, mechanism, by_axes)` for every way in which a player's inputs move a
/// mechanism; by_axes is false if only a button does.
template <class Visit>
void EachDriven(const World& world, const Visit& visit) {
  const Scene& scene = world.scene();
  const auto players = static_cast<int>(scene.players.size());
  const auto add = [&](int driver, int mechanism, bool by_axes) {
    const int player = PlayerOf(scene, driver);
    if (player >= 0 && mechanism >= 0) visit(player, mechanism, by_axes);
  };
  const auto add_part = [&](int driver, PartId part, bool by_axes = true) {
    if (driver >= 0 && part >= 0) add(driver, MechanismOf(world, part), by_axes);
  };
  const std::vector<Mechanism>& mechanisms = world.composition().mechanisms;
  for (std::size_t m = 0; m < mechanisms.size(); ++m) {
    add(mechanisms[m].owner, static_cast<int>(m), true);
  }
  for (int p = 0; p < players; ++p) {
    const Player& self = scene.players[static_cast<std::size_t>(p)];
    add_part(p, self.vehicle);
    for (const Action& action : self.actions) add_part(p, action.part, false);
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
    if (!part.gone) add_part(part.conveyor->player, part.id);
  }
}

}  // namespace

void Drivers::Find() {
  const Scene& scene = world_.scene();
  driven_.assign(scene.players.size(), {});
  moved_.assign(scene.players.size(), {});
  belts_.assign(scene.players.size(), {});
  by_axes_.assign(world_.composition().mechanisms.size(), 0);
  EachDriven(world_, [this](int player, int mechanism, bool by_axes) {
    driven_[static_cast<std::size_t>(player)].push_back(mechanism);
    if (!by_axes) return;
    moved_[static_cast<std::size_t>(player)].push_back(mechanism);
    by_axes_[static_cast<std::size_t>(mechanism)] = 1;
  });
  for (const Part& part : scene.parts) {
    const int player = PlayerOf(scene, part.conveyor->player);
    if (!part.gone && player >= 0 && MechanismOf(world_, part.id) < 0) {
      belts_[static_cast<std::size_t>(player)].push_back(part.id);
    }
  }
  for (std::vector<std::vector<int>>* lists : {&driven_, &moved_}) {
    for (std::vector<int>& all : *lists) {
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
    }
  }
}

void Drivers::Look() {
  if (revision_ != world_.topology().revision()) Find();
  revision_ = world_.topology().revision();
  concerns_.assign(driven_.size(), 0);
  concerned_.clear();
  for (std::size_t p = 0; p < driven_.size(); ++p) {
    const bool here =
        Moves(static_cast<int>(p), [this](int m) { return roles_.RoleOf(m) != kRoleRemote; });
    concerns_[p] = here ? 1 : 0;
    if (here) concerned_.push_back(static_cast<int>(p));
  }
}

std::vector<bool> DrivenMechanisms(const World& world, int player, bool actions) {
  std::vector<bool> driven(world.composition().mechanisms.size(), false);
  EachDriven(world, [&](int by, int mechanism, bool by_axes) {
    if (by == player && (by_axes || actions)) driven[static_cast<std::size_t>(mechanism)] = true;
  });
  return driven;
}

}  // namespace seam
