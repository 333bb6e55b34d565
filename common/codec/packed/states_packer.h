#pragma once
/// States for one receiver, as differences from those that it is known to have got.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
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
  bool empty() const { return !open_ && ready_.empty(); }
  /// What was added since, in its order.
  std::vector<Message> Take();
  /// A message has arrived.
  void Acknowledge(std::int64_t number);

 private:
  struct Sent {
    std::int32_t id = 0;
    std::int32_t count = 0;  // which it was of the body's
    PackedState state;
  };
  /// The newest state of a body that has arrived, and how many of it were sent.
  struct Known {
    std::int64_t number = -1;  // of the message that had it; -1: none has arrived
    std::int32_t count = 0, sent = 0;
    PackedState state;
  };
  void Begin(const States& states);
  void BeginGroup(const States& states);
  void End();
  void AddBody(const PackedState& state, std::int32_t id);
  void PutDifferences(const PackedState& state, const PackedState& guess,
                      std::array<Learned, kPackedFields>* learned);
  Known& KnownOf(std::int32_t id);

  const PackedMotion motion_;
  std::vector<Message> ready_;
  std::int64_t number_ = -1;  // of the message that is being written, or was last
  bool open_ = false;         // one is
  bool group_ = false;        // and a group in it
  BitWriter bits_;
  PackedContext context_;
  std::int32_t revision_ = 0;
  std::int64_t composition_ = 0;
  std::deque<std::vector<Sent>> sent_;  // of successive messages up to number_, the newest last
  std::vector<std::int32_t> place_;     // by id: in known_; -1: nothing was sent
  std::vector<Known> known_;
};

}  // namespace seam
