#include "common/sync/rest/rest_islands.h"

#include <algorithm>

#include "common/base/disjoint_sets.h"

namespace seam {

std::vector<std::vector<int>> FindPresentIslands(const World& world) {
  // Ascending; the sets are of places in this list.
  std::vector<int> mechanisms;
  for (const int body : world.present()) mechanisms.push_back(world.mechanism(body));
  std::sort(mechanisms.begin(), mechanisms.end());
  mechanisms.erase(std::unique(mechanisms.begin(), mechanisms.end()), mechanisms.end());
  const auto place_of = [&](int body) {
    const auto at = std::lower_bound(mechanisms.begin(), mechanisms.end(), world.mechanism(body));
    return static_cast<int>(at - mechanisms.begin());
  };
  DisjointSets sets(mechanisms.size());
  for (const Touch& touch : world.touches()) {
    sets.Unite(place_of(touch.body_a), place_of(touch.body_b));
  }
  std::vector<int> island_of(mechanisms.size(), -1);  // by the lowest place of its set
  std::vector<std::vector<int>> islands;
  for (const int body : world.present()) {
    int& island = island_of[static_cast<std::size_t>(sets.Find(place_of(body)))];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[static_cast<std::size_t>(island)].push_back(body);
  }
  return islands;
}

}  // namespace seam
