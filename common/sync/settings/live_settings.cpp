#include "common/sync/settings/live_settings.h"

#include <algorithm>
#include <cmath>

#include "common/base/limits.h"

namespace seam {

const std::array<LiveSetting, 2>& LiveSettings() {
  static const std::array<LiveSetting, 2> all{
      {{"input_delay", "input delay", kMetaInputDelay, kInputDelayTicksMax, kAdaptedDelayMax},
       {"show_age", "show age", kMetaShowAge, kShowAgeTicksMax, kShowAgeTicksMax}}};
  return all;
}

const LiveSetting* FindLiveSetting(const std::string& name) {
  for (const LiveSetting& setting : LiveSettings()) {
    if (setting.name == name) return &setting;
  }
  return nullptr;
}

const LiveSetting* FindLiveSetting(std::int8_t key) {
  for (const LiveSetting& setting : LiveSettings()) {
    if (setting.key == key) return &setting;
  }
  return nullptr;
}

bool HoldsSettings(const Meta& meta) {
  return !meta.key.empty() && meta.kind[0] == kMetaPlayer &&
         FindLiveSetting(meta.key[0]) != nullptr;
}

void PlayerSettings::Take(const Meta& meta, int player, int tick_hz) {
  for (std::size_t i = 0; i < meta.id.size(); ++i) {
    if (meta.kind[i] != kMetaPlayer || meta.id[i] != player) continue;
    const LiveSetting* const setting = FindLiveSetting(meta.key[i]);
    const float value = meta.value[i];
    if (setting == nullptr || !(value >= 0) || value > static_cast<float>(setting->most_followed))
      continue;
    if (value != std::floor(value)) continue;
    changes_.push_back({setting->key, meta.tick + SettingLead(tick_hz), static_cast<int>(value)});
  }
}

std::optional<int> PlayerSettings::At(std::int8_t key, std::int64_t tick) const {
  std::optional<int> value;
  for (const Change& change : changes_) {
    if (change.key == key && change.from <= tick) value = change.ticks;
  }
  return value;
}

void PlayerSettings::Forget(std::int64_t tick) {
  for (std::size_t i = 0; i < changes_.size();) {
    const Change& old = changes_[i];
    const bool replaced = std::any_of(
        changes_.begin() + static_cast<std::ptrdiff_t>(i) + 1, changes_.end(),
        [&](const Change& later) { return later.key == old.key && later.from <= tick; });
    if (replaced || changes_.size() > kPendingMax) {
      changes_.erase(changes_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

}  // namespace seam
