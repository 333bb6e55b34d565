#pragma once
/// Splits the server's messages of a log into its ticks, by the seals in the log.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/codec/codec.h"

namespace seam {

/// The server's messages of a tick, in their order.
struct TickMessages {
  std::int64_t tick = 0;
  std::vector<AnyMessage> before;     ///< published before the tick's step
  std::vector<AnyMessage> after;      ///< during and after it
  std::optional<std::uint16_t> hash;  ///< SealedTick::hash; recordings of 0.25 have none
};

class TickSplitter {
 public:
  /// Adds a message of the server other than a seal.
  void Add(AnyMessage message) { messages_.push_back(std::move(message)); }
  /// Returns the ticks that a seal of the server ends. A seal that was kept although the next one
  /// repeats it is known by its number of messages.
  std::vector<TickMessages> End(const LogSeal& seal);
  /// Returns the tick that a checksum of 0.25 ends, with all messages `before`.
  std::vector<TickMessages> End(const TickChain& chain);

 private:
  std::vector<AnyMessage> Take(std::size_t count);

  std::vector<AnyMessage> messages_;
  std::size_t carried_ = 0;  // of messages_: of earlier seals without ticks
  std::int64_t last_tick_ = -1;
};

}  // namespace seam
