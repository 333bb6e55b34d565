#include "common/measure/limit/driven.h"

#include "common/scene/ownership.h"

namespace seam {

std::vector<bool> DrivenBy(const World& world, int player) {
  const Scene& scene = world.scene();
  const Composition& composition = world.composition();
  std::vector<bool> driven(composition.mechanisms.size(), false);
  const auto sitter = [&](std::size_t seat) { return scene.seats[seat].player; };
  EachOwnPart(scene, player, sitter, [&](PartId part) {
    const int m = MechanismIn(composition, part);
    if (m >= 0) driven[static_cast<std::size_t>(m)] = true;
  });
  std::vector<bool> own;
  for (int body = 0; body < world.body_count(); ++body) {
    own.push_back(driven[static_cast<std::size_t>(world.mechanism(body))]);
  }
  return own;
}

}  // namespace seam
