#pragma once
/// Reads what a StatesPacker wrote; distrusts every bit of it.

#include <cstdint>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/messages.h"
#include "common/codec/packed/packed_states.h"
#include "common/codec/packed/packing.h"

namespace seam {

class StatesUnpacker {
 public:
  explicit StatesUnpacker(const PackedMotion& motion) : motion_(motion) {}

  /// The States that the message tells, all valid, in its order, until the next call; nullptr when
  /// it is malformed or tells differences from what never came: then it is as if it had been lost.
  /// Takes memory in proportion to what has come, and for a body of kPackedKept states at most:
  /// mostly of those since what its newest differences are from.
  const std::vector<States>* Take(const PackedStates& packed);
  /// States that are kept, of all bodies together.
  std::size_t kept() const;

 private:
  struct Kept {
    std::int64_t number = 0;  // of the message
    PackedState state;
  };
  struct Body {
    std::vector<Kept> all;  // those with the largest numbers, ascending
    /// A message that came a while ago, and what its difference was from: of those sent since none
    /// is from what is older. -1: from none.
    std::int64_t marked = -1, marked_from = -1;
  };
  struct Entry {
    std::int32_t id = 0;
    std::int64_t from = -1;  // number of the message that it is a difference from; -1: of none
    PackedState state;
  };
  States* Begin(const States& header, const PackedState& first);
  bool TakeBody(BitReader* bits, std::int64_t number, Entry* entry);
  const PackedState* Find(std::int32_t id, std::int64_t number) const;
  void Keep(std::int64_t number, const Entry& entry);

  const PackedMotion motion_;
  PackedContext context_;
  std::int64_t newest_ = 0;          // number of a message
  std::vector<std::int32_t> place_;  // by id: in kept_; -1: nothing came
  std::vector<Body> kept_;
  // Of the last message. A client takes one in every tick: their memory is used again.
  std::vector<States> told_, spare_;
  std::vector<Entry> entries_;
};

}  // namespace seam
