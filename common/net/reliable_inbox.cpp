#include "common/net/reliable_inbox.h"

#include "common/net/link.h"
#include "common/net/sequence_window.h"

namespace seam {

bool ReliableInbox::InWindow(const std::vector<DatagramMessage>& messages) const {
  std::size_t bytes = early_bytes_;
  for (const DatagramMessage& message : messages) {
    const std::int64_t id = message.reliable ? Unwrap(message.id, next_) : -1;
    if (id >= next_ + kReliableWindow) return false;
    if (id > next_ && early_.count(id) == 0) bytes += message.bytes.size;
  }
  return bytes <= kReliableWindowBytes;
}

bool ReliableInbox::Has(std::uint16_t wire) const {
  const std::int64_t id = Unwrap(wire, next_);
  return id < next_ || early_.count(id) > 0;
}

void ReliableInbox::Take(const DatagramMessage& message, const Sink& deliver) {
  const std::int64_t id = Unwrap(message.id, next_);
  if (id == next_ && early_.empty()) {
    ++next_;
    return deliver(message.bytes);
  }
  early_.emplace(id, Bytes(message.bytes.begin(), message.bytes.end()));
  early_bytes_ += message.bytes.size;
  while (!early_.empty() && early_.begin()->first == next_) {
    const Bytes next = early_.extract(next_++).mapped();
    early_bytes_ -= next.size();
    deliver(next);
  }
}

}  // namespace seam
