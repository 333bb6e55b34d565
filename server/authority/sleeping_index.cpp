#include "server/authority/sleeping_index.h"

#include <algorithm>
#include <utility>

#include "server/authority/crowds.h"

namespace seam {
namespace {

/// m, so that rounding leaves out nothing at exactly the limit.
constexpr float kLimitRounding = 0.1f;

}  // namespace

PlanSight SightOf(const AuthorityView& view) {
  float longest = 0;
  for (const PlayerView& player : view.players) longest = std::max(longest, player.one_way_s);
  return {ZoneSeconds(longest, longest) + kZoneKeep, view.buffer_m + kHysteresis};
}

void SleepingIndex::Clear(std::size_t mechanisms) {
  boxes_.Clear(mechanisms);
  found_in_.assign(mechanisms, 0);
  looks_ = 0;
}

std::vector<int> SleepingIndex::Near(const std::vector<MovingBox>& boxes, const PlanSight& sight) {
  boxes_.Tidy();
  ++looks_;
  std::vector<int> found;       // mechanisms
  std::vector<MovingBox> seen;  // their boxes
  const auto take = [&](int mechanism, const MovingBox& box) {
    int& found_in = found_in_[static_cast<std::size_t>(mechanism)];
    if (std::exchange(found_in, looks_) == looks_) return;
    found.push_back(mechanism);
    seen.push_back(box);
  };
  const auto within = [&](const MovingBox& box, float reach) {
    const Vec2 by(reach + kLimitRounding, reach + kLimitRounding);
    boxes_.EachWithin(box.min - by, box.max + by, take);
  };
  for (const MovingBox& box : boxes) within(box, kZoneSlack + WayOf(box, sight.seconds));
  for (std::size_t i = 0; i < seen.size(); ++i) within(MovingBox(seen[i]), kZoneSlack);
  const std::size_t touched = seen.size();
  for (const MovingBox& box : boxes) within(box, sight.around);
  for (std::size_t i = 0; i < touched; ++i) within(MovingBox(seen[i]), sight.around);
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace seam
