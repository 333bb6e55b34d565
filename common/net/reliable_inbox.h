#pragma once
/// Receiving side of reliable messages: delivers each once and in order.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "common/base/bytes.h"
#include "common/net/datagram.h"

namespace seam {

class ReliableInbox {
 public:
  /// Returns true if all reliable messages of a datagram are within the receive window
  /// (kReliableWindow, kReliableWindowBytes). Anything beyond must be rejected.
  bool InWindow(const std::vector<DatagramMessage>& messages) const;

  /// Returns true if the reliable message with this id was taken before.
  bool Has(std::uint16_t id) const;

  using Sink = std::function<void(ByteView)>;
  /// Takes a message of the window: delivers it and the messages held back behind it, or holds it
  /// until all earlier ones have come. Requires !Has(message.id).
  void Take(const DatagramMessage& message, const Sink& deliver);

 private:
  std::int64_t next_ = 0;                // id of the next message to deliver
  std::map<std::int64_t, Bytes> early_;  // later messages, by id
  std::size_t early_bytes_ = 0;          // their total
};

}  // namespace seam
