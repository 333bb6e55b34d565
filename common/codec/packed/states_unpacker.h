#pragma once
/// Unpacks the messages of a StatesPacker; validates every bit.

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

  /// Returns the Reset that asks the sender of a refused message to begin anew.
  static Reset Refusal(const PackedStates& packed);

  /// Returns the valid States in the message, in order; they live until the next call. nullptr when
  /// it is malformed or refers to a state that never came: it then counts as lost. Keeps at most
  /// kPackedKept states per body, usually only those since the reference state of its newest
  /// differences. Refuses bodies with an id from `ids` on: memory grows with the largest one.
  const std::vector<States>* Take(const PackedStates& packed, std::int32_t ids = kIdsMax);
  /// Returns the number of states kept, over all bodies.
  std::size_t kept() const;

 private:
  struct Kept {
    std::int64_t number = 0;  // number of its message
    WireBody state;
  };
  struct Body {
    std::vector<Kept> all;  // newest states, ascending by number
    /// A past message and the number of its reference state (-1: none): no later message refers to
    /// an older state.
    std::int64_t marked = -1, marked_from = -1;
  };
  struct Entry {
    std::int64_t from = -1;  // message of its reference state; -1: none
    WireBody state;
  };
  States* Begin(const States& header, const WireBody& first);
  bool TakeBody(RangeReader* bits, std::int64_t number, Entry* entry);
  const WireBody* Find(std::int32_t id, std::int64_t number) const;
  void Keep(std::int64_t number, const Entry& entry);

  const PackedMotion motion_;
  PackedContext context_;
  std::int32_t ids_ = kIdsMax;       // ids in this message are below
  std::int64_t newest_ = 0;          // largest message number so far
  /// Of the newest messages, each at its number modulo kPackedHeadersKept.
  std::vector<PackedHeader> headers_ = std::vector<PackedHeader>(kPackedHeadersKept);
  std::vector<std::int32_t> place_;  // by id: index in kept_; -1: nothing came
  std::vector<Body> kept_;
  // Contents of the last message. A client takes one in every tick, so their memory is reused.
  std::vector<States> told_, spare_;
  std::vector<Entry> entries_;
};

}  // namespace seam
