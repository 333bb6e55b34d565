#include "common/sync/rest/rest_disturbed.h"

#include "common/sync/rest/rest_islands.h"

namespace seam {

std::vector<bool> DrivenIn(const World& world, const Drivers& drivers,
                           const std::vector<InputTrack>& inputs, std::int64_t tick) {
  std::vector<bool> driven(world.composition().mechanisms.size(), false);
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    if (inputs[p].At(tick) == Input{}) continue;
    for (const int m : drivers.MovedBy(static_cast<int>(p)))
      driven[static_cast<std::size_t>(m)] = true;
  }
  return driven;
}

std::vector<int> DisturbedRest(const World& world, const Drivers& drivers, const BodyMemory& memory,
                               const std::vector<InputTrack>& inputs) {
  std::vector<int> disturbed;
  bool woken = false;
  for (const int body : world.present()) {
    woken = woken || (memory.track(body).at_rest && world.awake(body));
  }
  if (!woken) return disturbed;
  const std::vector<bool> driven = DrivenIn(world, drivers, inputs, world.tick());
  for (const std::vector<int>& island : FindPresentIslands(world)) {
    bool real = false;
    for (const int body : island) {
      const bool struck = world.awake(body) && world.Read(body).velocity.norm() > kRestImpactSpeed;
      real = real || struck || driven[static_cast<std::size_t>(world.mechanism(body))];
    }
    for (const int body : island) {
      if (real && memory.track(body).at_rest && world.awake(body)) disturbed.push_back(body);
    }
  }
  return disturbed;
}

}  // namespace seam
