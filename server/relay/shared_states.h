#pragma once
/// States for many receivers, packed once for all of them: no message refers to an earlier one. A
/// receiver that lost a message gets the newest states of the bodies of which no later message
/// tells.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "common/base/bytes.h"
#include "common/codec/packed/states_packer.h"
#include "common/codec/wire_body.h"

namespace seam {

class SharedStates {
 public:
  explicit SharedStates(const PackedMotion& motion) : packer_(motion) {}

  /// An encoded message, and its number, from 0 on.
  struct Message {
    std::int64_t number = 0;
    Bytes bytes;
  };
  /// Adds states for all receivers.
  void Add(const States& states);
  bool empty() const { return added_.empty(); }
  /// Returns the messages with all states added since the last call.
  std::vector<Message> Take(std::int64_t now_us);
  /// Returns messages with the newest states of these bodies (ascending ids), for one receiver.
  /// Requires that nothing was added since the last Take.
  std::vector<Message> Again(std::int64_t now_us, const std::vector<std::int32_t>& ids);
  /// Appends the bodies whose newest state is the one in this message.
  void AddNewestIn(std::int64_t number, std::vector<std::int32_t>* ids) const;

  /// Most messages of which the contents are known: two seconds of a large room with many losses.
  /// A message lost for longer is not told again; the next state of each body is.
  static constexpr std::size_t kMessagesMost = 4096;

 private:
  /// A state in a message, named by the number of the message that first carried it.
  struct Carried {
    std::int32_t id = 0;
    std::int64_t first = 0;
  };
  struct Newest {
    StatesHeader header;
    WireBody body;
    std::int64_t first = -1;  // message that first carried it; -1: none
  };
  std::vector<Message> Finish(std::int64_t now_us, bool again);

  StatesPacker packer_;
  std::vector<std::int32_t> added_;           // in the order of the messages
  std::vector<Newest> newest_;                // by id
  std::deque<std::vector<Carried>> carried_;  // of the messages up to newest_number_
  std::int64_t newest_number_ = -1;
};

/// The messages of a SharedStates that one receiver was sent.
class SentStates {
 public:
  /// Messages come with ascending numbers.
  void NoteSent(std::int64_t number, std::int64_t now_us) { sent_.push_back({number, now_us}); }
  /// Counts a message as lost: its path did not carry it.
  void NoteLeftOut(std::int64_t number) { sent_.push_back({number, kLost}); }
  void Acknowledge(std::int64_t number);
  /// Returns the bodies (ascending ids) to be told again: of messages that are not acknowledged
  /// `late_us` after they were sent.
  std::vector<std::int32_t> TakeLost(std::int64_t now_us, std::int64_t late_us,
                                     const SharedStates& states);
  /// Call when the receiver is told everything.
  void Clear() { sent_.clear(); }

 private:
  static constexpr std::int64_t kLost = INT64_MIN;
  struct Sent {
    std::int64_t number = 0;
    std::int64_t sent_us = 0;
    bool arrived = false;
  };
  std::deque<Sent> sent_;
};

}  // namespace seam
