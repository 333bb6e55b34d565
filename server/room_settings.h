#pragma once
/// Settings of the players' clients that an operator changes while the room runs (LiveSetting).

#include "common/base/status.h"
#include "common/scene/scene.h"
#include "common/sync/metadata.h"
#include "common/sync/mode.h"
#include "common/sync/settings/live_settings.h"

namespace seam {

class RoomSettings {
 public:
  /// `scene` must outlive it.
  RoomSettings(const Scene& scene, const SyncConfig& config)
      : scene_(scene),
        oracle_(config.policy->IsOracle()),
        input_delay_ticks_(config.input_delay_ticks) {}

  /// Changes a setting of all players' clients. Returns one line if the value is out of range, or
  /// nobody follows it.
  Status Change(const LiveSetting& setting, int ticks);
  /// Changes the input delay to one that the server has found to be needed, at most
  /// kAdaptedDelayMax.
  void Adapt(int input_delay_ticks) { Set(kMetaInputDelay, input_delay_ticks); }
  /// Returns the newest value of a setting, ticks: of those changed here, or the room's first.
  int newest(const LiveSetting& setting) const;

  /// The changed settings, by player, as they are told.
  MetaTable& table() { return table_; }

 private:
  void Set(std::int8_t key, int ticks);

  const Scene& scene_;
  const bool oracle_;
  const int input_delay_ticks_;  // the room's first
  MetaTable table_;
};

}  // namespace seam
