#include "common/measure/screen/input_delays.h"

#include <algorithm>

#include "common/base/limits.h"

namespace seam {

InputDelays::InputDelays(const Recording& recording) : first_(recording.room.input_delay_ticks) {
  for (const Meta& meta : recording.meta) {
    if (!HoldsSettings(meta)) continue;
    const std::int32_t last = *std::max_element(meta.id.begin(), meta.id.end());
    const auto players = static_cast<std::size_t>(std::min(last + 1, kPlayersMax));
    settings_.resize(std::max(settings_.size(), players));
    for (std::size_t p = 0; p < settings_.size(); ++p) {
      settings_[p].Take(meta, static_cast<int>(p), recording.room.tick_hz);
    }
  }
}

int InputDelays::Of(int player, std::int64_t tick) const {
  if (static_cast<std::size_t>(player) >= settings_.size()) return first_;
  const PlayerSettings& settings = settings_[static_cast<std::size_t>(player)];
  for (int delay = kAdaptedDelayMax; delay >= 0; --delay) {
    if (settings.At(kMetaInputDelay, tick - delay).value_or(first_) == delay) return delay;
  }
  return first_;
}

}  // namespace seam
