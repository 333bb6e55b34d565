#include "server/load/islands.h"

#include <cstddef>
#include <numeric>
#include <vector>

namespace seam {
namespace {

/// Union-find with path halving.
class Sets {
 public:
  explicit Sets(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int Find(int i) {
    while (At(i) != i) i = At(i) = At(At(i));
    return i;
  }
  void Join(int a, int b) { At(Find(a)) = Find(b); }

 private:
  int& At(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

}  // namespace

int CountIslands(const World& world) {
  const int bodies = world.body_count();
  Sets sets(bodies);
  std::vector<int> first(world.composition().mechanisms.size(), -1);  // awake body of each
  for (int body = 0; body < bodies; ++body) {
    if (!world.awake(body)) continue;
    int& before = first[static_cast<std::size_t>(world.mechanism(body))];
    if (before >= 0) sets.Join(body, before);
    before = body;
  }
  for (const Touch& touch : world.touches()) {
    if (world.awake(touch.body_a) && world.awake(touch.body_b))
      sets.Join(touch.body_a, touch.body_b);
  }
  int islands = 0;
  for (int body = 0; body < bodies; ++body) {
    if (world.awake(body) && sets.Find(body) == body) ++islands;
  }
  return islands;
}

}  // namespace seam
