#pragma once
/// The delays of inputs in a recording: the room's, and what an operator has made of it since.

#include <cstdint>
#include <vector>

#include "common/record/recording.h"
#include "common/sync/settings/live_settings.h"

namespace seam {

class InputDelays {
 public:
  explicit InputDelays(const Recording& recording);

  /// Returns the ticks from reading the player's input that acts in a tick to that tick. After a
  /// change, an input that was read before it comes first.
  int Of(int player, std::int64_t tick) const;

 private:
  int first_;                             // of the room, ticks
  std::vector<PlayerSettings> settings_;  // by player
};

}  // namespace seam
