#pragma once
/// Settings of the players' clients that an operator changes while a room runs. They travel as
/// values of the players (Meta), and act at one tick everywhere.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/codec/messages.h"

namespace seam {

/// One setting, in ticks.
struct LiveSetting {
  const char* name;   ///< its key in scene files
  const char* title;  ///< for people
  std::int8_t key;    ///< of the Meta
  int most;           ///< ticks, that an operator may set; the least is 0
  int most_followed;  ///< ticks, that a client takes: the server itself may need more
};

/// Largest input delay that a server chooses, ticks. Inputs of twice as many ticks may be on their
/// way to a peer, and must fit one message. Less makes rooms on long ways wait for each tick.
constexpr int kAdaptedDelayMax = 24;

constexpr std::int8_t kMetaInputDelay = 5;  ///< ticks from reading an input to its acting
constexpr std::int8_t kMetaShowAge = 6;     ///< greatest age of others' displayed bodies, ticks

const std::array<LiveSetting, 2>& LiveSettings();
/// Returns the setting of this name, or of this key; nullptr if there is none.
const LiveSetting* FindLiveSetting(const std::string& name);
const LiveSetting* FindLiveSetting(std::int8_t key);
/// True if the values of the message are settings: they never share one with the rules' values.
bool HoldsSettings(const Meta& meta);

/// Returns the ticks from Meta::tick to the tick from which its settings act: half a second, within
/// which the message reaches every client. Fewer, and clients would change one after the other;
/// more, and the operator waits.
constexpr int SettingLead(int tick_hz) { return tick_hz / 2; }

/// The settings of one player, as they came.
class PlayerSettings {
 public:
  /// Takes the player's settings of a message. Ignores values that are not whole ticks in range.
  void Take(const Meta& meta, int player, int tick_hz);
  /// Returns the value that acts in this tick, ticks; nullopt: as the room began.
  std::optional<int> At(std::int8_t key, std::int64_t tick) const;
  /// Forgets changes that others have replaced by this tick, and all but the newest kPendingMax.
  void Forget(std::int64_t tick);
  void Clear() { changes_.clear(); }

  /// More are no operator's; the oldest are forgotten.
  static constexpr std::size_t kPendingMax = 64;

 private:
  struct Change {
    std::int8_t key = 0;
    std::int64_t from = 0;  // tick
    int ticks = 0;
  };
  std::vector<Change> changes_;  // in the order of their arrival
};

}  // namespace seam
