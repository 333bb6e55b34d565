#pragma once
/// Reliable messages on their way out: which is to be sent when, until it is acknowledged.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>

#include "common/base/bytes.h"

namespace seam {

class ReliableQueue {
 public:
  ReliableQueue();

  /// False when 4096 are waiting. `urgent`: to be repeated on the chance.
  bool Push(ByteView message, bool urgent);
  /// A datagram that carried the message has arrived.
  void NoteAcked(std::int64_t id);
  /// A message is late when it is not acknowledged so long after it was sent, us.
  void SetLate(std::int64_t late_us);

  /// Whether something is to be sent now, in a datagram of its own if need be.
  bool Due(std::int64_t now_us) const;
  /// After that said no: when it may be, us.
  std::int64_t DueUs() const { return due_us_; }
  using Pack = std::function<void(std::int64_t id, ByteView message)>;
  /// What is to be sent now. `rides`: a datagram goes out in any case.
  void Take(std::int64_t now_us, bool rides, const Pack& pack);

  bool empty() const { return messages_.empty(); }
  std::size_t size() const { return messages_.size(); }

 private:
  struct Message {
    std::int64_t id = 0;
    std::int64_t sent_us = -1;  // -1: not yet
    bool chance = false;        // to be repeated once before it is late
    bool acked = false;
    Bytes bytes;
  };
  std::int64_t DueUs(const Message& message, std::int64_t chance_us) const;
  std::int64_t FirstDueUs() const;
  /// Lets in what fits.
  void FillWindow();
  /// For a repeat on the chance.
  void Pay(std::int64_t now_us, const Message& message);

  std::deque<Message> messages_;
  std::size_t window_ = 0;        // so many of the first of them are the window,
  std::size_t window_bytes_ = 0;  // that are so long
  std::int64_t next_id_ = 0;
  std::int64_t late_us_;
  std::int64_t chances_paid_us_ = 0;  // by then for what was repeated on the chance
  mutable std::int64_t due_us_ = 0;   // before that none of the window is due
};

}  // namespace seam
