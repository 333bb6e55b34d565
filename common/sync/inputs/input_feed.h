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
/// Longest time between two sends of an input that is not acknowledged, us: over a tick at 60 Hz.
/// In rooms with longer ticks the repeats come between them; only one a tick would lose every input
/// whose datagram is lost, and a tick of 100 ms with it.
constexpr std::int64_t kInputRepeatUs = 20000;

class InputFeed {
 public:
  /// Returns how many of the newest ticks (InputTrack::Export) to send now; 0: none. `acked`:
  /// newest tick that the peer has acknowledged, -1: none. `now`: our own tick, at `now_us`; known
  /// ones are sent again in the next tick or after kInputRepeatUs. `rides`: other messages go to
  /// the peer now.
  int Take(const InputTrack& track, std::int64_t acked, std::int64_t now, std::int64_t now_us,
           bool rides);
  /// The same where peers wait for each input: all that are not acknowledged, at most kInputsMax,
  /// as soon as one is new, and again after kInputRepeatUs.
  int TakeAll(const InputTrack& track, std::int64_t acked, std::int64_t now_us);
  /// True if inputs are known that have not been sent.
  bool Waits(const InputTrack& track) const { return track.newest() > sent_newest_; }

 private:
  std::int64_t sent_newest_ = -1, sent_at_ = -1, sent_us_ = 0;
};

}  // namespace seam
