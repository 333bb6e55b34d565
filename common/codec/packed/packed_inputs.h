#pragma once
/// Inputs packed as bits: the message, its packer and its unpacker.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/packed/bits.h"
#include "common/codec/packed/packed_states.h"

namespace seam {

/// Both directions: all inputs that the receiver does not have yet, of other players or of the
/// client's own. As plain Inputs
/// (60 per second and player) most bytes would be repeated values and message headers: 82 bytes
/// each with framing, 310 kB/s for a client among 63 others. Written by InputsPacker, read by
/// UnpackInputs.
struct PackedInputs {
  std::vector<std::uint8_t> bits;  ///< 1..kPackedBytesMax bytes
};

/// Writes self-contained messages: any of the messages may be lost.
class InputsPacker {
 public:
  /// Adds the newest `newest` ticks of these inputs, or all if there are fewer. Returns false and
  /// adds nothing if the message has no room or already has this player or one with a larger index:
  /// call Finish first. Requires valid Inputs of a player below kPlayersMax with at least one tick.
  bool Add(const Inputs& inputs, std::size_t newest = kInputsMax);
  bool empty() const { return player_ < 0; }
  /// Returns the message and begins the next. Requires at least one Add.
  PackedInputs Finish();

 private:
  BitWriter bits_;
  int player_ = -1;          // last added player, -1: none
  std::int64_t newest_ = 0;  // newest tick of the first added player
};

/// Returns the valid Inputs in the message, at most one per player, ordered by player; utime and
/// sequence are 0. nullopt when the message is malformed.
std::optional<std::vector<Inputs>> UnpackInputs(const PackedInputs& packed);

}  // namespace seam
