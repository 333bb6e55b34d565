#pragma once
/// Reliable messages on their way in: each once, and in order.

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
  /// Whether the reliable ones among a datagram's messages are of the window (kReliableWindow,
  /// kReliableWindowBytes): no others wait for their turn.
  bool InWindow(const std::vector<DatagramMessage>& messages) const;

  /// Whether a reliable message with that id was taken before.
  bool Has(std::uint16_t id) const;

  using Sink = std::function<void(ByteView)>;
  /// Takes one that was not, of the window: delivers it and those that have waited for it, or keeps
  /// it until those before it have come.
  void Take(const DatagramMessage& message, const Sink& deliver);

 private:
  std::int64_t next_ = 0;                // id of the next to deliver
  std::map<std::int64_t, Bytes> early_;  // ahead of it
  std::size_t early_bytes_ = 0;          // of all of those
};

}  // namespace seam
