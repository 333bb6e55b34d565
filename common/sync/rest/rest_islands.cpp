#include "common/sync/rest/rest_islands.h"

#include <algorithm>
#include <numeric>

namespace seam {
namespace {

/// Returns the representative of the island of `m` (union-find with path halving).
int Leader(std::vector<int>* leaders, int m) {
  std::vector<int>& up = *leaders;
  while (up[static_cast<std::size_t>(m)] != m) {
    int& next = up[static_cast<std::size_t>(m)];
    next = up[static_cast<std::size_t>(next)];
    m = next;
  }
  return m;
}

}  // namespace

std::vector<std::vector<int>> FindPresentIslands(const World& world) {
  // Ascending; leaders are indexed by the place in this list.
  std::vector<int> mechanisms;
  for (const int body : world.present()) mechanisms.push_back(world.mechanism(body));
  std::sort(mechanisms.begin(), mechanisms.end());
  mechanisms.erase(std::unique(mechanisms.begin(), mechanisms.end()), mechanisms.end());
  const auto place_of = [&](int body) {
    const auto at = std::lower_bound(mechanisms.begin(), mechanisms.end(), world.mechanism(body));
    return static_cast<int>(at - mechanisms.begin());
  };
  std::vector<int> leaders(mechanisms.size());
  std::iota(leaders.begin(), leaders.end(), 0);
  for (const Touch& touch : world.touches()) {
    const int a = Leader(&leaders, place_of(touch.body_a));
    const int b = Leader(&leaders, place_of(touch.body_b));
    leaders[static_cast<std::size_t>(a)] = b;
  }
  std::vector<int> island_of(leaders.size(), -1);
  std::vector<std::vector<int>> islands;
  for (const int body : world.present()) {
    const auto leader = static_cast<std::size_t>(Leader(&leaders, place_of(body)));
    if (island_of[leader] < 0) {
      island_of[leader] = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[static_cast<std::size_t>(island_of[leader])].push_back(body);
  }
  return islands;
}

}  // namespace seam
