#pragma once
/// Where every part of a world is: parts of one body from the pose of their root.

#include <cmath>

#include "common/physics/world.h"

namespace seam {

/// Pose of a part, and the velocity of its body's centre of mass; false when it is gone.
inline bool ReadPart(const World& world, PartId id, BodyState* state) {
  const Composition& c = world.composition();
  if (id < 0 || static_cast<std::size_t>(id) >= c.assembly_of_part.size()) return false;
  const int index = c.assembly_of_part[static_cast<std::size_t>(id)];
  if (index < 0) return false;
  const Assembly& assembly = c.assemblies[static_cast<std::size_t>(index)];
  const Part& part = world.scene().parts[static_cast<std::size_t>(id)];
  if (assembly.anchored) {
    *state = {part.position, part.angle, {0, 0}, 0};
    return true;
  }
  *state = world.Read(world.BodyOfId(assembly.id));
  if (id == assembly.id) return true;
  const Part& root = world.scene().parts[static_cast<std::size_t>(assembly.id)];
  const float turn = state->angle - root.angle;
  const float cosine = std::cos(turn), sine = std::sin(turn);
  const Vec2 from_root = part.position - root.position;
  state->position += Vec2(cosine * from_root.x() - sine * from_root.y(),
                          sine * from_root.x() + cosine * from_root.y());
  state->angle = part.angle + turn;
  return true;
}

/// The mechanism of a part; -1 when it is anchored or gone.
inline int MechanismOf(const World& world, PartId id) {
  const Composition& c = world.composition();
  if (id < 0 || static_cast<std::size_t>(id) >= c.assembly_of_part.size()) return -1;
  const int index = c.assembly_of_part[static_cast<std::size_t>(id)];
  return index < 0 ? -1 : c.assemblies[static_cast<std::size_t>(index)].mechanism;
}

/// Whose a mechanism is: the player whose vehicle is part of it, else its owner; -1 nobody's.
inline int PlayerOf(const World& world, int mechanism) {
  if (mechanism < 0) return -1;
  const std::vector<Player>& players = world.scene().players;
  for (std::size_t p = 0; p < players.size(); ++p) {
    if (players[p].vehicle >= 0 && MechanismOf(world, players[p].vehicle) == mechanism) {
      return static_cast<int>(p);
    }
  }
  return world.composition().mechanisms[static_cast<std::size_t>(mechanism)].owner;
}

}  // namespace seam
