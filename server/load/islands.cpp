#include "server/load/islands.h"

#include <cstddef>
#include <vector>

#include "common/base/disjoint_sets.h"

namespace seam {

int CountIslands(const World& world) {
  const int bodies = world.body_count();
  DisjointSets sets(static_cast<std::size_t>(bodies));
  std::vector<int> first(world.composition().mechanisms.size(), -1);  // awake body of each
  for (int body = 0; body < bodies; ++body) {
    if (!world.awake(body)) continue;
    int& before = first[static_cast<std::size_t>(world.mechanism(body))];
    if (before >= 0) sets.Unite(body, before);
    before = body;
  }
  for (const Touch& touch : world.touches()) {
    if (world.awake(touch.body_a) && world.awake(touch.body_b))
      sets.Unite(touch.body_a, touch.body_b);
  }
  int islands = 0;
  for (int body = 0; body < bodies; ++body) {
    if (world.awake(body) && sets.Find(body) == body) ++islands;
  }
  return islands;
}

}  // namespace seam
