#pragma once
/// Send queue of one receiver: bodies with a state to send, and the receiver's byte budget.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/wire_body.h"
#include "common/net/send_credit.h"
#include "common/sync/limits.h"
#include "server/interest/newest_states.h"

namespace seam {

/// Default of the most that a client is sent, bytes/s: 2 Mb/s.
constexpr double kClientBytesPerS = 256000;

/// Weight of a state; its priority is the weight times its waiting time (after Fiedler, "State
/// Synchronization", 2015).
enum class Urgency : std::uint8_t { kFar = 1, kNear = 3, kFollowed = 10 };

class SendQueue {
 public:
  /// `bytes_per_s`: limit for everything sent to the receiver, UDP payload; 0: no limit.
  explicit SendQueue(double bytes_per_s) : most_per_s_(bytes_per_s) {}

  /// Sets the rate that the path carries, which is another limit. `full`: it was full once.
  void SetPath(double bytes_per_s, bool full) {
    path_per_s_ = bytes_per_s;
    full_ = full;
  }
  /// Returns the lesser limit, bytes/s; 0: none.
  double bytes_per_s() const {
    const bool path = path_per_s_ > 0 && (most_per_s_ <= 0 || path_per_s_ < most_per_s_);
    return path ? path_per_s_ : most_per_s_;
  }
  /// True if the path is the lesser limit, and was full once.
  bool IsThin() const { return full_ && bytes_per_s() == path_per_s_; }
  /// True if the budget allows a datagram now.
  bool Ready(std::int64_t now_us);
  /// Returns the bytes that may be sent, as of the last Ready or Compose.
  std::size_t allowed() const;
  /// Returns the bytes of states of followed bodies, as a share of the full path's rate; 0
  /// while the path is not full. Of the last kLoadUs.
  float FollowedLoad(std::int64_t now_us);
  /// Counts states of followed bodies that were not queued.
  void NoteFollowed(std::size_t bodies) { followed_ += each_ * static_cast<double>(bodies); }

  /// Queues a body. The next Compose that has room for it sends its latest state.
  void Add(std::int64_t now_us, PartId id, Urgency urgency);
  /// Takes bytes that were sent to the receiver, in messages of any kind, out of the budget.
  void Spend(std::size_t bytes) { credit_.Spend(bytes); }
  /// States for one message: one authority, one tick, all near one origin.
  struct Message {
    StatesHeader header;
    const WireBody *begin = nullptr, *end = nullptr;  ///< ids ascend
    std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  };
  /// Dequeues the states of highest priority, as many as the budget allows now, and returns them as
  /// messages. The result is valid until the next call.
  const std::vector<Message>& Compose(std::int64_t now_us, const NewestStates& newest);
  bool empty() const { return waiting_.empty(); }
  /// Round robin over the mechanisms out of the receiver's interest, kept by the caller: the
  /// mechanism of the last turn, and the time at which this round began, us.
  int nothing = 0;
  std::int64_t distant_round_us = -1000000000;
  /// True if a body that the receiver simulates is queued.
  bool pressing() const { return pressing_; }
  /// True if the budget allows a message with so many bodies now.
  bool Affords(std::int64_t now_us, std::size_t bodies);
  /// Updates the estimate of bytes per body by the size of a message.
  void NoteCost(std::size_t bytes, std::size_t bodies);

  /// Time over which FollowedLoad is the mean, us.
  static constexpr std::int64_t kLoadUs = 2000000;
  /// us between two sends when the budget does not cover the whole queue: many small messages would
  /// be mostly headers.
  static constexpr std::int64_t kPartEveryUs = 15000;

 private:
  struct Waiting {
    PartId id = 0;
    Urgency urgency = Urgency::kFar;
    std::int64_t since_us = 0;
  };
  /// Sort key of the states in a Compose: the states of one message are adjacent.
  struct Place {
    std::int32_t peer;
    std::int64_t tick;
    PartId id;
    bool operator<(const Place& o) const;
  };
  /// Splits order_ into messages.
  void ComposeInOrder(const NewestStates& newest);
  /// Moves the states of highest priority to the front of the queue; returns how many fit the
  /// budget.
  std::size_t Affordable(std::int64_t now_us);

  double most_per_s_, path_per_s_ = 0;
  bool full_ = false;
  SendCredit credit_;
  double followed_ = 0;  // bytes since loaded_us_
  float load_ = 0;
  std::int64_t loaded_us_ = -1;
  std::int64_t part_us_ = -1000000000;  // time of the last send of only a part of the queue
  std::vector<Waiting> waiting_;
  bool pressing_ = false;
  std::vector<Message> composed_;  // by the last Compose
  std::vector<WireBody> bodies_;   // of composed_
  std::vector<Place> order_;
  std::vector<std::int32_t> place_;  // by part: index in waiting_; -1: not queued
  double each_ = static_cast<double>(kStatesBytes.each);  // bytes per body, running mean
};

}  // namespace seam
