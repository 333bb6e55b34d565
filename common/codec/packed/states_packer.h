#pragma once
/// Packs States for one receiver as differences from acknowledged states.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/packed/packed_states.h"
#include "common/codec/packed/packing.h"

namespace seam {

class StatesPacker {
 public:
  explicit StatesPacker(const PackedMotion& motion) : motion_(motion) {}

  /// A message to send, and its number for Acknowledge.
  struct Message {
    std::int64_t number = 0;
    std::size_t bodies = 0;
    PackedStates packed;
  };
  /// Adds the contents of a States except utime and sequence.
  void Add(const States& states);
  /// Adds bodies with ascending ids, at the header's tick.
  void Add(const StatesHeader& header, const WireBody* begin, const WireBody* end);
  bool empty() const { return !open_ && ready_.empty(); }
  /// Returns the messages with everything added since the last call, in order, to be sent at
  /// `now_us`.
  std::vector<Message> Take(std::int64_t now_us);
  /// Returns bodies to resend: their message is not acknowledged `late_us` after it was sent, nor
  /// is any later state of the body. Each is returned at once, after 100 ms, after another 200 ms,
  /// then every 400 ms, until a state is acknowledged; bodies not `wanted` are dropped.
  using Wanted = std::function<bool(std::int32_t id)>;
  std::vector<std::int32_t> TakeLost(std::int64_t now_us, std::int64_t late_us,
                                     const Wanted& wanted);
  /// Marks a message as arrived.
  void Acknowledge(std::int64_t number);
  /// The receiver refused a message, whatever acknowledgements say: no state up to it counts as
  /// known, and all are lost (TakeLost). `number`: its lowest 16 bits; ignored if not yet sent.
  void Reset(std::uint16_t number);

 private:
  struct Sent {
    WireBody state;
    std::int32_t count = 0;  // number of the state among those sent of the body, from 1
  };
  struct SentMessage {
    PackedHeader header;
    std::vector<Sent> bodies;  // empty once acknowledged
  };
  /// A message in flight or lost.
  struct InFlight {
    std::int64_t number = 0, sent_us = 0;
  };
  /// A body with a lost state, its `count`-th.
  struct Owed {
    std::int32_t id = 0, count = 0;
    std::int64_t due_us = 0, again_us = 0;
  };
  /// The newest acknowledged state of a body, and the number of states sent.
  struct Known {
    std::int64_t number = -1;  // message that carried the state; -1: none acknowledged
    std::int32_t count = 0, sent = 0;
    WireBody state;
  };
  void Begin(const StatesHeader& header);
  void BeginGroup(const StatesHeader& header);
  /// True if a body may be added to the open group: the same peer and tick, and a higher id.
  bool Continues(const StatesHeader& header, std::int32_t id) const;
  /// Adds a body, in a new message if the open one is full. `*begun`: the open group is for these
  /// bodies; if not, begins a group and sets it.
  void AddEntry(const StatesHeader& header, const WireBody& state, bool* begun);
  void End();
  void Spare(std::vector<Sent>* bodies);
  void AddBody(const WireBody& state);
  Known& KnownOf(std::int32_t id);
  /// Returns a message that was sent; nullptr if no longer recorded.
  SentMessage* Find(std::int64_t number);
  /// Adds to owed_ the unacknowledged states that were sent by `until_us`.
  void FindLostStates(std::int64_t until_us);
  void MergeOwed();

  const PackedMotion motion_;
  std::vector<Message> ready_;
  std::int64_t number_ = -1;   // number of the open message, else of the last
  std::int64_t refused_ = -1;  // no acknowledgement up to this message counts
  bool open_ = false;         // a message is being written
  bool group_ = false;        // the open message has an open group
  RangeWriter bits_;
  PackedContext context_;
  std::int32_t peer_ = 0;  // of the open group
  PackedHeader header_;    // of the open message, else of the last
  PackedHeader arrived_;   // of the newest message that is acknowledged
  std::deque<SentMessage> sent_;          // successive messages up to number_
  std::deque<InFlight> in_flight_;        // oldest first, until checked for loss
  std::vector<Owed> owed_;                // ascending by id
  std::vector<std::vector<Sent>> spare_;  // empty vectors for reuse
  std::vector<std::int32_t> place_;       // by id: index in known_; -1: nothing sent
  std::vector<Known> known_;
};

}  // namespace seam
