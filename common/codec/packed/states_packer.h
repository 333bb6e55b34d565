#pragma once
/// States for one receiver, as differences from those that it is known to have got.

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

  /// A message to be sent, and the number that Acknowledge knows it by.
  struct Message {
    std::int64_t number = 0;
    std::size_t bodies = 0;
    PackedStates packed;
  };
  /// Adds what a States tells, but for utime and sequence.
  void Add(const States& states);
  /// The same of these bodies, whose ids ascend; the tick of their states is the header's.
  void Add(const PackedHeader& header, const PackedEntry* begin, const PackedEntry* end);
  bool empty() const { return !open_ && ready_.empty(); }
  /// What was added since, in its order, to be sent at `now_us`.
  std::vector<Message> Take(std::int64_t now_us);
  /// Bodies to be told again: those of messages that have not arrived `late_us` after they were
  /// sent, as far as is known, while nothing newer of the body has. Each until something has, now,
  /// 100 ms later, 200 ms after that, then every 400; one that is not `wanted` is forgotten.
  using Wanted = std::function<bool(std::int32_t id)>;
  std::vector<std::int32_t> TakeLost(std::int64_t now_us, std::int64_t late_us,
                                     const Wanted& wanted);
  /// A message has arrived.
  void Acknowledge(std::int64_t number);

 private:
  struct Sent {
    std::int32_t id = 0;
    std::int32_t count = 0;  // which it was of the body's
    PackedState state;
  };
  /// A message that may have been lost.
  struct UnderWay {
    std::int64_t number = 0, sent_us = 0;
  };
  /// A body of which a state was lost, its `count`-th.
  struct Owed {
    std::int32_t id = 0, count = 0;
    std::int64_t due_us = 0, again_us = 0;
  };
  /// The newest state of a body that has arrived, and how many of it were sent.
  struct Known {
    std::int64_t number = -1;  // of the message that had it; -1: none has arrived
    std::int32_t count = 0, sent = 0;
    PackedState state;
  };
  void Begin(const PackedHeader& header);
  void BeginGroup(const PackedHeader& header);
  /// An entry of a message of whose entries `*begun` says whether any is in the open group.
  void AddEntry(const PackedHeader& header, std::int32_t id, const PackedState& state, bool* begun);
  void End();
  void Spare(std::vector<Sent>* bodies);
  void AddBody(const PackedState& state, std::int32_t id);
  void PutDifferences(const PackedState& state, const PackedState& guess,
                      std::array<Learned, kPackedFields>* learned);
  Known& KnownOf(std::int32_t id);
  /// What a message told, nothing once it is acknowledged; nullptr: forgotten.
  std::vector<Sent>* SentIn(std::int64_t number);
  /// Of what was sent until then what has not arrived.
  void FindOwed(std::int64_t until_us);

  const PackedMotion motion_;
  std::vector<Message> ready_;
  std::int64_t number_ = -1;  // of the message that is being written, or was last
  bool open_ = false;         // one is
  bool group_ = false;        // and a group in it
  BitWriter bits_;
  PackedContext context_;
  std::int32_t revision_ = 0;
  std::int64_t composition_ = 0;
  std::deque<std::vector<Sent>> sent_;    // of successive messages up to number_, the newest last
  std::deque<UnderWay> under_way_;        // the oldest first, until it has arrived or is late
  std::vector<Owed> owed_;                // ascending
  std::vector<std::vector<Sent>> spare_;  // empty
  std::vector<std::int32_t> place_;       // by id: in known_; -1: nothing was sent
  std::vector<Known> known_;
};

}  // namespace seam
