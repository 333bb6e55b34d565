#include "common/sync/rest/rest_islands.h"

#include <numeric>

namespace seam {
namespace {

/// The mechanism that stands for the island of `m` (union-find with halved paths).
int Leader(std::vector<int>* leaders, int m) {
  std::vector<int>& up = *leaders;
  while (up[static_cast<std::size_t>(m)] != m) {
    int& next = up[static_cast<std::size_t>(m)];
    next = up[static_cast<std::size_t>(next)];
    m = next;
  }
  return m;
}

std::vector<std::vector<int>> Islands(const World& world, bool absent_too) {
  std::vector<int> leaders(world.composition().mechanisms.size());
  std::iota(leaders.begin(), leaders.end(), 0);
  for (const Touch& touch : world.touches()) {
    const int a = Leader(&leaders, world.mechanism(touch.body_a));
    const int b = Leader(&leaders, world.mechanism(touch.body_b));
    leaders[static_cast<std::size_t>(a)] = b;
  }
  std::vector<int> place(leaders.size(), -1);
  std::vector<std::vector<int>> islands;
  for (int body = 0; body < world.body_count(); ++body) {
    if (!absent_too && world.motion(body) == Motion::kAbsent) continue;
    const auto leader = static_cast<std::size_t>(Leader(&leaders, world.mechanism(body)));
    if (place[leader] < 0) {
      place[leader] = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[static_cast<std::size_t>(place[leader])].push_back(body);
  }
  return islands;
}

}  // namespace

std::vector<std::vector<int>> FindIslands(const World& world) { return Islands(world, true); }

std::vector<std::vector<int>> FindPresentIslands(const World& world) {
  return Islands(world, false);
}

}  // namespace seam
