#pragma once
/// Send queue of reliable messages: decides when each is sent and resent until acknowledged.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>

#include "common/base/bytes.h"

namespace seam {

class ReliableQueue {
 public:
  ReliableQueue();

  /// Queues a message; false when 4096 are queued. `urgent`: send one speculative duplicate.
  bool Push(ByteView message, bool urgent);
  /// Marks the message as acknowledged.
  void MarkAcked(std::int64_t id);
  /// Sets the retransmission timeout, us.
  void SetRetransmissionTimeout(std::int64_t late_us);

  /// Returns true if a message is due now, even in a datagram of its own.
  bool Due(std::int64_t now_us) const;
  /// Returns the earliest time at which a message may be due, us. Valid after Due returned false.
  std::int64_t DueUs() const { return due_us_; }
  using Pack = std::function<void(std::int64_t id, ByteView message)>;
  /// Calls `pack` for each message due now, of at most `most_bytes` besides the first one. `rides`:
  /// a datagram goes out in any case, so that duplicates may go earlier.
  void Take(std::int64_t now_us, bool rides, std::size_t most_bytes, const Pack& pack);

  bool empty() const { return messages_.empty(); }
  std::size_t size() const { return messages_.size(); }
  /// Returns the time of the last call before which everything queued has been sent once, us. Call
  /// it at each tick.
  std::int64_t SentUntilUs(std::int64_t now_us);

 private:
  struct Message {
    std::int64_t id = 0;
    std::int64_t sent_us = -1;  // time of the last send, -1: not yet
    bool chance = false;        // its speculative duplicate is still to be sent
    bool acked = false;
    Bytes bytes;
  };
  std::int64_t DueUs(const Message& message, std::int64_t chance_us) const;
  std::int64_t FirstDueUs() const;
  bool HasUnsent() const { return sent_ < window_; }
  /// Extends the window by as many messages as fit.
  void FillWindow();
  /// Charges a speculative duplicate to the rate limit.
  void ChargeDuplicate(std::int64_t now_us, const Message& message);

  struct Mark {
    std::int64_t us, id;  // the first message that was queued later
  };

  std::deque<Message> messages_;
  std::deque<Mark> marks_;  // of calls of SentUntilUs, one for each tick with a message
  std::int64_t sent_until_us_ = 0;
  std::size_t window_ = 0;        // number of leading messages in the window
  std::size_t sent_ = 0;          // number of leading messages that were sent
  std::size_t window_bytes_ = 0;  // their bytes
  std::int64_t next_id_ = 0;
  std::int64_t late_us_;
  std::int64_t duplicates_paid_us_ = 0;  // time at which past duplicates fit the rate limit
  mutable std::int64_t due_us_ = 0;      // no message that was sent is due before
};

}  // namespace seam
