#include <algorithm>
#include <utility>

#include "common/record/recording.h"

namespace seam {
namespace {

/// Most views waiting for further parts, normal 1 per peer; beyond it the oldest tick is dropped.
constexpr std::size_t kPartialMax = 256;

template <class T>
void Append(std::vector<T>* to, const std::vector<T>& from) {
  to->insert(to->end(), from.begin(), from.end());
}

}  // namespace

bool RecordingBuilder::Keep(View& part) {
  if (part.parts == 1) return KeepWhole(part);
  const std::pair<std::int64_t, int> key(part.tick, part.peer);
  std::vector<View>& parts = partial_[key];
  if (!parts.empty() && parts.front().parts != part.parts) parts.clear();
  const auto place = std::lower_bound(parts.begin(), parts.end(), part,
                                      [](const View& a, const View& b) { return a.part < b.part; });
  if (place != parts.end() && place->part == part.part) {
    *place = std::move(part);
  } else {
    parts.insert(place, std::move(part));
  }
  if (parts.size() < static_cast<std::size_t>(parts.front().parts)) {
    if (partial_.size() > kPartialMax) partial_.erase(partial_.begin());
    return true;
  }
  View whole = std::move(parts.front());
  for (auto next = parts.begin() + 1; next != parts.end(); ++next) {
    Append(&whole.id, next->id);
    Append(&whole.role, next->role);
    Append(&whole.authority, next->authority);
    for (const auto field :
         {&View::x, &View::y, &View::angle, &View::vx, &View::vy, &View::spin, &View::age}) {
      Append(&(whole.*field), (*next).*field);
    }
  }
  whole.parts = 1;
  partial_.erase(key);
  return KeepWhole(whole);
}

bool RecordingBuilder::KeepWhole(View& view) {
  const auto not_below = [](std::int32_t a, std::int32_t b) { return a >= b; };
  if (std::adjacent_find(view.id.begin(), view.id.end(), not_below) != view.id.end()) {
    ++recording_.undecodable;  // the parts do not fit together
    return false;
  }
  KeepUnmoved(view);
  const bool first = recording_.last_tick < 0;
  recording_.first_tick = first ? view.tick : std::min(recording_.first_tick, view.tick);
  recording_.last_tick = std::max(recording_.last_tick, view.tick);
  if (heard_us_ >= 0) recording_.view_us[view.peer][view.tick] = heard_us_;
  recording_.views[view.peer][view.tick] = std::move(view);
  return true;
}

void RecordingBuilder::KeepUnmoved(const View& view) {
  auto& views = recording_.views[view.peer];
  const auto before = views.find(view.tick - view.unmoved - 1);
  if (view.unmoved == 0 || before == views.end()) return;
  for (int i = 1; i <= view.unmoved; ++i) {
    View same = before->second;
    same.tick += i;
    same.utime += (view.utime - same.utime) * i / (view.unmoved + 1);
    same.unmoved = 0;
    views.emplace(same.tick, std::move(same));
  }
  if (heard_us_ < 0) return;
  auto& times = recording_.view_us[view.peer];
  const auto heard = times.find(before->first);
  if (heard == times.end()) return;
  for (int i = 1; i <= view.unmoved; ++i) {
    times[before->first + i] = heard->second + (heard_us_ - heard->second) * i / (view.unmoved + 1);
  }
}

}  // namespace seam
