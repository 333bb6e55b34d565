#pragma once
/// Ownership by the scene alone, without the authorities of a session: the same for all methods.

#include <algorithm>

#include "common/scene/assembly.h"
#include "common/scene/character.h"

namespace seam {

/// Returns the mechanism of a part; -1: it is anchored, gone, or -1.
inline int MechanismIn(const Composition& composition, PartId part) {
  if (part < 0) return -1;
  const int assembly = composition.assembly_of_part[static_cast<std::size_t>(part)];
  return assembly < 0 ? -1 : composition.assemblies[static_cast<std::size_t>(assembly)].mechanism;
}

/// Returns the lowest player that has its vehicle in the mechanism; -1: none.
inline int VehicleOwner(const Scene& scene, const Composition& composition, int mechanism) {
  const auto has = [&](const Player& player) {
    return player.vehicle >= 0 && MechanismIn(composition, player.vehicle) == mechanism;
  };
  const auto found = std::find_if(scene.players.begin(), scene.players.end(), has);
  return found == scene.players.end() ? -1 : static_cast<int>(found - scene.players.begin());
}

/// Calls `visit` (a part), maybe more than once, for each part that makes its mechanism the
/// player's own: the player's vehicle, parts with the player as owner, the torsos of its
/// characters, and parts with a seat on which it sits. `sitter(seat)` returns the player on a seat.
template <class Sitter, class Visit>
void EachOwnPart(const Scene& scene, int player, const Sitter& sitter, const Visit& visit) {
  const PartId vehicle = scene.players[static_cast<std::size_t>(player)].vehicle;
  if (vehicle >= 0) visit(vehicle);
  for (const Part& part : scene.parts) {
    if (part.owner == player && !part.gone) visit(part.id);
  }
  for (const Character& character : scene.characters) {
    if (character.player == player) visit(character.parts[kTorso]);
  }
  for (std::size_t seat = 0; seat < scene.seats.size(); ++seat) {
    if (sitter(seat) == player) visit(scene.seats[seat].part);
  }
}

}  // namespace seam
