#include "client/swarm/held.h"

#include "common/sync/moving.h"

namespace seam {

int MovingHeld(const Replica& replica, int peer) {
  const World& world = replica.world();
  int moving = 0;
  for (int body = 0; body < world.body_count(); ++body) {
    if (replica.authority().at(world.mechanism(body)).authority != peer) continue;
    if (IsMoving(world, body)) ++moving;
  }
  return moving;
}

}  // namespace seam
