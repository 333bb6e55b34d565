#pragma once
/// Inputs as bits: the message, its bound and its two ends.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/packed/bits.h"
#include "common/codec/packed/packed_states.h"

namespace seam {

/// Server -> client: Inputs of other players, all that are news to it. They come 60 times a second
/// of each, and as Inputs most of their bytes would say what is held and which message it is: 82
/// bytes each, framed, 310 kB/s for a client among 63 others. InputsPacker writes and UnpackInputs
/// reads them.
struct PackedInputs {
  std::vector<std::uint8_t> bits;  ///< 1..kPackedBytesMax bytes
};

/// Writes messages, each of which is understood by itself: any of them may be lost.
class InputsPacker {
 public:
  /// Of these inputs the newest so many ticks, all if there are less. False, and nothing is taken,
  /// if the message has no room for it, or something of this player or of a later one: then Finish
  /// first. Requires valid Inputs of a player below kPlayersMax, and at least one tick.
  bool Add(const Inputs& inputs, std::size_t newest = kInputsMax);
  bool empty() const { return player_ < 0; }
  /// The message with what was added, at least one; begins the next.
  PackedInputs Finish();

 private:
  BitWriter bits_;
  int player_ = -1;          // of the last that was added; -1: none
  std::int64_t newest_ = 0;  // tick of the first that was added
};

/// What the message tells, all valid, in the order of players, each at most once; utime and
/// sequence are 0. Nothing when it is malformed.
std::optional<std::vector<Inputs>> UnpackInputs(const PackedInputs& packed);

}  // namespace seam
