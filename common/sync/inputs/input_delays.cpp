#include "common/sync/inputs/input_delays.h"

#include <algorithm>

namespace seam {

void InputDelays::Take(const Event& event, int tick_hz) {
  const std::int64_t ticks = event.value_milli / 1000;
  const std::int64_t from = event.tick + DelayNotice(tick_hz);
  const bool good = ticks >= 0 && ticks <= kAdaptedDelayMax && from > changes_.back().first;
  if (event.kind != static_cast<std::int8_t>(EventKind::kInputDelay) || !good) return;
  Change(from, static_cast<int>(ticks));
}

int InputDelays::At(std::int64_t read_tick) const {
  auto at = changes_.rbegin();
  while (at->first > read_tick && std::next(at) != changes_.rend()) ++at;
  return at->second;
}

std::int64_t InputDelays::ReadTick(std::int64_t tick) const {
  for (auto at = changes_.rbegin(); std::next(at) != changes_.rend(); ++at) {
    const std::int64_t last_before = at->first - 1 + std::next(at)->second;
    if (tick > last_before) return std::max(at->first - 1, tick - at->second);
  }
  return tick - changes_.front().second;
}

}  // namespace seam
