#include "common/sync/reach/zones.h"

#include <algorithm>

#include "common/base/spatial/box_sweep.h"
#include "common/base/spatial/disjoint_sets.h"

namespace seam {

std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes, float seconds) {
  return MeetingGroups(boxes, seconds, [seconds](int, int) { return seconds; });
}

std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes,
                                               float seconds_max,
                                               const std::function<float(int, int)>& seconds_of) {
  // Each box is grown by its own possible travel; boxes of two that may meet then overlap.
  const BoxSweep sweep(boxes, [&](std::size_t i) {
    return boxes[i].velocity.norm() * seconds_max + kZoneSlack / 2 +
           boxes[i].acceleration * seconds_max * seconds_max / 2;
  });
  std::vector<std::pair<int, int>> pairs;
  sweep.EachPair([&](std::size_t i, std::size_t j) {
    const MovingBox &a = boxes[i], &b = boxes[j];
    if (a.group == b.group) return;
    if (!MayMeet(a, b, std::min(seconds_max, seconds_of(a.group, b.group)))) return;
    pairs.emplace_back(std::min(a.group, b.group), std::max(a.group, b.group));
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::vector<int> Components(int count, const std::vector<std::pair<int, int>>& pairs) {
  DisjointSets components(static_cast<std::size_t>(count));
  for (const auto& [a, b] : pairs) components.Unite(a, b);
  return components.Lowest();
}

}  // namespace seam
