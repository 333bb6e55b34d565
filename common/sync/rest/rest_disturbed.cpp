#include "common/sync/rest/rest_disturbed.h"

#include "common/sync/rest/rest_islands.h"

namespace seam {

bool DrivenIn(const World& world, const std::vector<InputTrack>& inputs, int body,
              std::int64_t tick) {
  const auto m = static_cast<std::size_t>(world.mechanism(body));
  const int owner = world.composition().mechanisms[m].owner;
  return owner >= 0 && !(inputs[static_cast<std::size_t>(owner)].At(tick) == Input{});
}

std::vector<int> DisturbedRest(const World& world, const BodyMemory& memory,
                               const std::vector<InputTrack>& inputs) {
  std::vector<int> disturbed;
  bool woken = false;
  for (const int body : world.present()) {
    woken = woken || (memory.track(body).at_rest && world.awake(body));
  }
  if (!woken) return disturbed;
  for (const std::vector<int>& island : FindPresentIslands(world)) {
    bool real = false;
    for (const int body : island) {
      const bool struck = world.awake(body) && world.Read(body).velocity.norm() > kRestBlow;
      real = real || struck || DrivenIn(world, inputs, body, world.tick());
    }
    for (const int body : island) {
      if (real && memory.track(body).at_rest && world.awake(body)) disturbed.push_back(body);
    }
  }
  return disturbed;
}

}  // namespace seam
