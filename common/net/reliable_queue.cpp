#include "common/net/reliable_queue.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/base/limits.h"
#include "common/net/datagram.h"
#include "common/net/link.h"

namespace seam {
namespace {

/// Most messages in the queue, window included.
constexpr std::size_t kWaitMax = 4096;
/// Most bytes sent in one Take: eight datagrams. At 60 Hz 4.4 Mb/s; more floods a slow path.
constexpr std::size_t kTakeBytes = 8 * kMessageBytesMax;
/// Retransmission timeout before the round trip is known, us.
constexpr std::int64_t kFirstTimeoutUs = 250'000;
/// Delay of an urgent message's speculative duplicate, us: the first with a datagram that goes out
/// anyway, the second in one of its own. If the original was lost, the receiver need not wait for
/// another round trip.
constexpr std::int64_t kDuplicateRidesUs = 12'000, kDuplicateDelayUs = 35'000;
/// Rate limit of speculative duplicates, bytes per second; a burst is about one datagram.
constexpr std::int64_t kDuplicateBytesPerS = 32'000;
constexpr std::int64_t kDuplicateBurstUs = 1'000'000 * kMessageBytesMax / kDuplicateBytesPerS;

}  // namespace

ReliableQueue::ReliableQueue() : late_us_(kFirstTimeoutUs) {}

bool ReliableQueue::Push(ByteView message, bool urgent) {
  if (messages_.size() >= kWaitMax) return false;
  Message queued;
  queued.id = next_id_++;
  queued.chance = urgent;
  queued.bytes.assign(message.begin(), message.end());
  messages_.push_back(std::move(queued));
  FillWindow();
  return true;
}

void ReliableQueue::MarkAcked(std::int64_t id) {
  const auto index = static_cast<std::size_t>(messages_.empty() ? -1 : id - messages_.front().id);
  if (index < messages_.size()) messages_[index].acked = true;
  while (!messages_.empty() && messages_.front().acked) {
    window_bytes_ -= messages_.front().bytes.size();
    --window_;
    sent_ -= std::min<std::size_t>(sent_, 1);
    messages_.pop_front();
  }
  FillWindow();
}

std::int64_t ReliableQueue::SentUntilUs(std::int64_t now_us) {
  const std::int64_t unsent = next_id_ - static_cast<std::int64_t>(messages_.size() - sent_);
  if (unsent == next_id_) {
    marks_.clear();
    return sent_until_us_ = now_us;
  }
  if (marks_.empty() || marks_.back().id < next_id_) marks_.push_back({now_us, next_id_});
  for (; marks_.front().id <= unsent; marks_.pop_front()) sent_until_us_ = marks_.front().us;
  return sent_until_us_;
}

void ReliableQueue::SetRetransmissionTimeout(std::int64_t late_us) {
  if (late_us < late_us_) due_us_ = 0;  // a resend may be due earlier now
  late_us_ = late_us;
}

void ReliableQueue::FillWindow() {
  while (window_ < messages_.size() && window_ < kReliableWindow) {
    const std::size_t bytes = messages_[window_].bytes.size();
    if (window_bytes_ + bytes > kReliableWindowBytes) return;
    window_bytes_ += bytes;
    ++window_;
  }
}

/// Returns the due time of an unacknowledged message; its speculative duplicate is due `chance_us`
/// after the last send.
std::int64_t ReliableQueue::DueUs(const Message& message, std::int64_t chance_us) const {
  if (message.sent_us < 0) return 0;
  const std::int64_t late_us = message.sent_us + late_us_;
  if (!message.chance) return late_us;
  const std::int64_t paid_us = duplicates_paid_us_ - kDuplicateBurstUs;
  return std::min(late_us, std::max(message.sent_us + chance_us, paid_us));
}

std::int64_t ReliableQueue::FirstDueUs() const {
  std::int64_t due_us = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < window_; ++i) {
    if (!messages_[i].acked) due_us = std::min(due_us, DueUs(messages_[i], kDuplicateDelayUs));
  }
  return due_us;
}

bool ReliableQueue::Due(std::int64_t now_us) const {
  return HasUnsent() || (now_us >= due_us_ && now_us >= (due_us_ = FirstDueUs()));
}

void ReliableQueue::ChargeDuplicate(std::int64_t now_us, const Message& message) {
  const auto bytes = static_cast<std::int64_t>(FramedBytes(message.bytes.size(), true));
  duplicates_paid_us_ =
      std::max(duplicates_paid_us_, now_us) + 1'000'000 * bytes / kDuplicateBytesPerS;
}

void ReliableQueue::Take(std::int64_t now_us, bool rides, std::size_t most_bytes,
                         const Pack& pack) {
  if (now_us < due_us_ && !HasUnsent() && !rides) return;
  const std::int64_t chance_us = rides ? kDuplicateRidesUs : kDuplicateDelayUs;
  std::size_t budget = std::min(kTakeBytes, most_bytes);
  bool first = true;
  for (std::size_t i = 0; i < window_; ++i) {
    Message& message = messages_[i];
    if (message.acked || now_us < DueUs(message, chance_us)) continue;
    if (message.bytes.size() > budget && !std::exchange(first, false)) break;
    budget -= std::min(budget, message.bytes.size());
    first = false;
    if (message.sent_us >= 0) {
      if (now_us - message.sent_us < late_us_) ChargeDuplicate(now_us, message);
      message.chance = false;
    }
    message.sent_us = now_us;
    sent_ = std::max(sent_, i + 1);
    pack(message.id, message.bytes);
  }
  due_us_ = FirstDueUs();
}

}  // namespace seam
