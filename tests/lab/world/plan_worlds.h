#pragma once
/// Random views of rooms, for what plans them.

#include "server/authority/plan.h"

namespace seam {

struct PlanWorld {
  int players = 4, mechanisms = 100;
  float width = 200, height = 40;  ///< m, of the room, its middle at 0
  float speed = 8;                 ///< m/s at most, of what is not a player's
  float fast = 0.05f;              ///< share of what is ten times faster
  bool chains = true;              ///< some mechanisms of many boxes
  float one_way_s = 0.15f;         ///< of players, at most
  bool regions = true;             ///< one for each player, side by side; else islands
  int follow_bodies = 256, server_follow = 256;
};

/// Every player has a vehicle of three boxes; the rest are single boxes, some of them fast, a few
/// chains of boxes that are longer than a cell. Who has and follows what now is random.
AuthorityView RandomView(const PlanWorld& world, std::uint64_t seed);

}  // namespace seam
