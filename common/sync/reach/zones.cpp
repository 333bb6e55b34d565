#include "common/sync/reach/zones.h"

#include <algorithm>

#include "common/base/disjoint_sets.h"

namespace seam {

std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes, float seconds) {
  return MeetingGroups(boxes, seconds, [seconds](int, int) { return seconds; });
}

std::vector<std::pair<int, int>> MeetingGroups(const std::vector<MovingBox>& boxes,
                                               float seconds_max,
                                               const std::function<float(int, int)>& seconds_of) {
  // Each box is grown by its own possible travel; boxes of two that may meet then overlap.
  struct Span {
    float from, to;
    std::size_t box;
  };
  std::vector<Span> spans;
  spans.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const MovingBox& box = boxes[i];
    const float by = box.velocity.norm() * seconds_max + kZoneSlack / 2 +
                     box.acceleration * seconds_max * seconds_max / 2;
    spans.push_back({box.min.x() - by, box.max.x() + by, i});
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
    return a.from != b.from ? a.from < b.from : a.box < b.box;
  });
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const MovingBox& a = boxes[spans[i].box];
    for (std::size_t j = i + 1; j < spans.size() && spans[j].from <= spans[i].to; ++j) {
      const MovingBox& b = boxes[spans[j].box];
      if (a.group == b.group) continue;
      if (!MayMeet(a, b, std::min(seconds_max, seconds_of(a.group, b.group)))) continue;
      pairs.emplace_back(std::min(a.group, b.group), std::max(a.group, b.group));
    }
  }
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
