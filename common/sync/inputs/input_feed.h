#pragma once
/// Decides which of one player's inputs to send to one peer, and when. Inputs that the peer would
/// not predict are sent at once and until acknowledged; all others only along with other messages.

#include <cstdint>

#include "common/sync/inputs/input_track.h"

namespace seam {

/// Ticks of input in one message: the most, and the least if so many are known.
constexpr int kInputsRedundant = 16, kInputsAtLeast = 3;
static_assert(static_cast<std::size_t>(kInputsRedundant) <= kInputsMax,
              "a peer would reject such inputs as malformed");

class InputFeed {
 public:
  /// Returns how many of the newest ticks (InputTrack::Export) to send now; 0: none. `acked`:
  /// newest tick that the peer has acknowledged, -1: none. `now`: our own tick; only new inputs are
  /// sent twice within one. `rides`: other messages go to the peer now.
  int Take(const InputTrack& track, std::int64_t acked, std::int64_t now, bool rides);
  /// True if inputs are known that have not been sent.
  bool Waits(const InputTrack& track) const { return track.newest() > sent_newest_; }

 private:
  std::int64_t sent_newest_ = -1, sent_at_ = -1;
};

}  // namespace seam
