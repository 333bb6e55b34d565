#include "client/swarm/held.h"

#include "common/sync/moving.h"

namespace seam {

int MovingHeld(const Replica& replica, int peer) {
  const World& world = replica.world();
  const Composition& made = world.composition();
  int moving = 0;
  for (int m = 0; m < replica.authority().count(); ++m) {
    if (replica.authority().at(m).authority != peer) continue;
    for (const int assembly : made.mechanisms[static_cast<std::size_t>(m)].assemblies) {
      const int body = world.BodyOfId(made.assemblies[static_cast<std::size_t>(assembly)].id);
      if (body >= 0 && IsMoving(world, body)) ++moving;
    }
  }
  return moving;
}

}  // namespace seam
