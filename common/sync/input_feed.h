#pragma once
/// What of one player's inputs is sent to one peer, and when: what it would not guess at once and
/// until it is acknowledged, the rest along with other messages.

#include <cstdint>
#include <optional>

#include "common/sync/input_track.h"

namespace seam {

/// Ticks of input in one message: at most, and where so many are known, at least.
constexpr int kInputsRedundant = 16, kInputsAtLeast = 3;
static_assert(static_cast<std::size_t>(kInputsRedundant) <= kInputsMax,
              "a peer would reject such inputs as malformed");

class InputFeed {
 public:
  /// The message to send now, if any. `acked`: the newest tick that the peer has acknowledged, -1:
  /// none. `now`: our own tick; nothing is sent twice within one, but for what is new. `rides`:
  /// other messages go to the peer now.
  std::optional<Inputs> Take(const InputTrack& track, int player, std::int64_t acked,
                             std::int64_t now, bool rides);

 private:
  std::int64_t sent_newest_ = -1, sent_at_ = -1;
};

}  // namespace seam
