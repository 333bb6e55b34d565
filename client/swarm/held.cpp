#include "client/swarm/held.h"

#include "common/scene/mechanism_ids.h"
#include "common/sync/moving.h"

namespace seam {

int MovingHeld(const Replica& replica, int peer) {
  const World& world = replica.world();
  int moving = 0;
  for (int m = 0; m < replica.authority().count(); ++m) {
    if (replica.authority().at(m).authority != peer) continue;
    EachIdOf(world.composition(), m, [&](PartId id) {
      const int body = world.BodyOfId(id);
      if (body >= 0 && IsMoving(world, body)) ++moving;
    });
  }
  return moving;
}

}  // namespace seam
