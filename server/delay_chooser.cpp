#include "server/delay_chooser.h"

#include <algorithm>
#include <functional>

#include "common/sync/settings/live_settings.h"

namespace seam {

void DelayChooser::Note(std::size_t player, std::int64_t way_us) {
  Ways& ways = ways_[player];
  if (ways.us.size() < kWaysMax) {
    ways.us.push_back(way_us);
    return;
  }
  ways.us[ways.next] = way_us;
  ways.next = (ways.next + 1) % kWaysMax;
}

std::optional<int> DelayChooser::Needed() const {
  std::vector<std::int64_t> longest;  // by player
  for (const Ways& ways : ways_) {
    if (ways.us.size() < kWaysMin) continue;
    std::vector<std::int64_t> us = ways.us;
    const auto at = us.begin() + static_cast<std::ptrdiff_t>((us.size() - 1) * 99 / 100);
    std::nth_element(us.begin(), at, us.end());
    longest.push_back(*at);
  }
  if (longest.empty()) return std::nullopt;
  std::sort(longest.begin(), longest.end(), std::greater<>());
  const std::int64_t us = longest[0] + (longest.size() > 1 ? longest[1] : 0);
  const std::int64_t ticks = (us * tick_hz_ + 999999) / 1000000;
  return static_cast<int>(std::clamp<std::int64_t>(ticks, 1, kAdaptedDelayMax));
}

std::optional<int> DelayChooser::Choose(int now) const {
  const std::optional<int> needed = Needed();
  if (!needed || (*needed <= now && *needed > now - 2)) return std::nullopt;
  return needed;
}

}  // namespace seam
