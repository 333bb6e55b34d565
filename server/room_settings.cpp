#include "server/room_settings.h"

#include <cstdint>
#include <string>

namespace seam {

Status RoomSettings::Change(const LiveSetting& setting, int ticks) {
  if (ticks < 0 || ticks > setting.most) {
    return Status::Error(std::string(setting.name) + " takes 0 to " + std::to_string(setting.most) +
                         " ticks");
  }
  if (scene_.players.empty()) return Status::Error("the room has no players");
  if (oracle_) return Status::Error("in mode oracle nobody follows it: the scripts drive");
  Set(setting.key, ticks);
  return Status::Ok();
}

void RoomSettings::Set(std::int8_t key, int ticks) {
  const auto players = static_cast<std::int32_t>(scene_.players.size());
  for (std::int32_t player = 0; player < players; ++player) {
    table_.Set({kMetaPlayer, player, key}, static_cast<float>(ticks));
  }
}

int RoomSettings::newest(const LiveSetting& setting) const {
  const auto changed = table_.values().find({kMetaPlayer, 0, setting.key});
  if (changed != table_.values().end()) return static_cast<int>(changed->second);
  return setting.key == kMetaInputDelay ? input_delay_ticks_ : scene_.show_age_ticks;
}

}  // namespace seam
