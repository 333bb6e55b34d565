#pragma once
/// What of the newest states one receiver is still to be told, and how many bytes it may get.

#include <cstdint>
#include <vector>

#include "common/codec/messages.h"
#include "common/codec/packed/packing.h"
#include "common/sync/limits.h"
#include "server/interest/newest_states.h"

namespace seam {

/// What a client is sent at most unless the server is told otherwise, bytes/s: 2 Mb/s.
constexpr double kClientBytesPerS = 256000;

/// How urgent a state is: its weight times how long it has waited (after Fiedler, "State
/// Synchronization", 2015).
enum class Urgency : std::uint8_t { kFar = 1, kNear = 3, kFollowed = 10 };

class Outbox {
 public:
  /// `bytes_per_s`: of everything that the receiver is sent, UDP payload; 0: no limit.
  explicit Outbox(double bytes_per_s) : bytes_per_s_(bytes_per_s) {}

  /// A body has news for the receiver. Of several before the next Compose the newest is told.
  void Add(std::int64_t now_us, PartId id, Urgency urgency);
  /// So many bytes went to it, of whatever.
  void Spend(std::size_t bytes) { credit_ -= static_cast<double>(bytes); }
  /// What one message tells: of one authority and tick, within the reach of one origin.
  struct Message {
    PackedHeader header;
    const PackedEntry *begin = nullptr, *end = nullptr;  ///< ids ascend
    std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  };
  /// Messages with the most urgent of what waits, as many as the budget allows now; the rest waits
  /// on. They hold until the next call.
  const std::vector<Message>& Compose(std::int64_t now_us, const NewestStates& newest);
  bool empty() const { return waiting_.empty(); }
  /// Of what is nothing to the receiver: the last mechanism that had its turn, and since when turns
  /// have been taken from the first on, us. For who adds them.
  int nothing = 0;
  std::int64_t nothings_us = -1000000000;
  /// Whether anything waits that the receiver simulates.
  bool pressing() const { return pressing_; }
  /// Whether a message with so many bodies may go to it now.
  bool Affords(std::int64_t now_us, std::size_t bodies);
  /// A message with so many bodies had so many bytes: what the next ones are taken to cost.
  void NoteCost(std::size_t bytes, std::size_t bodies);

  /// s of the budget that may come at once.
  static constexpr double kBurst = 0.1;
  /// us between two messages of a part of what waits: many small ones would be mostly headers.
  static constexpr std::int64_t kPartEveryUs = 15000;

 private:
  struct Waiting {
    PartId id = 0;
    Urgency urgency = Urgency::kFar;
    std::int64_t since_us = 0;
  };
  /// What orders the states of a Compose: those of one message come one after the other.
  struct Place {
    std::int32_t peer;
    std::int64_t tick;
    PartId id;
    bool operator<(const Place& o) const;
  };
  void Fill(std::int64_t now_us);
  /// Of order_.
  void ComposeInOrder(const NewestStates& newest);
  /// The first so many of what waits, once ordered, fit the budget.
  std::size_t Affordable(std::int64_t now_us);

  double bytes_per_s_, credit_ = 0;
  std::int64_t part_us_ = -1000000000;  // when only a part of what waited could be sent
  std::int64_t filled_us_ = -1;
  std::vector<Waiting> waiting_;
  bool pressing_ = false;
  std::vector<Message> composed_;    // of the last Compose
  std::vector<PackedEntry> bodies_;  // of its messages
  std::vector<Place> order_;
  std::vector<std::int32_t> place_;  // by part: in waiting_, -1: it does not wait
  double each_ = static_cast<double>(kStatesBytes.each);  // bytes of a body, as it was lately
};

}  // namespace seam
