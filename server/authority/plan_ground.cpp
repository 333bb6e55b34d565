#include "server/authority/plan_ground.h"

#include "common/base/disjoint_sets.h"
#include "server/authority/box_sweep.h"

namespace seam {

Touching FindTouching(const std::vector<MovingBox>& boxes, const BoxClusters& clusters,
                      std::size_t groups) {
  Touching found;
  DisjointSets touching(groups);
  const BoxSweep sweep(clusters.around(), [](std::size_t) { return kPressGap / 2; });
  sweep.EachPair([&](std::size_t a, std::size_t b) {
    const int x = clusters.GroupOf(a), y = clusters.GroupOf(b);
    if (x == y) return;
    clusters.EachPair(a, b, [&](std::size_t i, std::size_t j) {
      if (Gap(boxes[i], boxes[j]) > kPressGap) return;
      touching.Unite(x, y);
      found.touched.push_back(x);
    });
  });
  found.lowest = touching.Lowest();
  return found;
}

}  // namespace seam
