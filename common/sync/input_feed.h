#pragma once
/// What of one player's inputs is sent to one peer, and when: what it would not guess at once and
/// until it is acknowledged, the rest along with other messages.

#include <cstdint>

#include "common/sync/input_track.h"

namespace seam {

/// Ticks of input in one message: at most, and where so many are known, at least.
constexpr int kInputsRedundant = 16, kInputsAtLeast = 3;
static_assert(static_cast<std::size_t>(kInputsRedundant) <= kInputsMax,
              "a peer would reject such inputs as malformed");

class InputFeed {
 public:
  /// How many of the newest ticks (InputTrack::Export) to send now; 0: nothing. `acked`: the newest
  /// tick that the peer has acknowledged, -1: none. `now`: our own tick; nothing is sent twice
  /// within one, but for what is new. `rides`: other messages go to the peer now.
  int Take(const InputTrack& track, std::int64_t acked, std::int64_t now, bool rides);
  /// Whether it knows of something that was not sent.
  bool Waits(const InputTrack& track) const { return track.newest() > sent_newest_; }

 private:
  std::int64_t sent_newest_ = -1, sent_at_ = -1;
};

}  // namespace seam
