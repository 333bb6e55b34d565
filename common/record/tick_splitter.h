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
  std::optional<std::uint16_t> hash;  ///< SealedTick::hash
};

class TickSplitter {
 public:
  /// `last_tick`: behind which the messages begin; earlier ticks that a seal repeats are left out.
  explicit TickSplitter(std::int64_t last_tick = -1) : last_tick_(last_tick) {}

  /// Adds a message of the server other than a seal.
  void Add(AnyMessage message) { messages_.push_back(std::move(message)); }
  /// Returns the ticks that a seal of the server ends. A seal that was kept although the next one
  /// repeats it is known by its number of messages.
  std::vector<TickMessages> End(const LogSeal& seal);
  /// Returns the messages that the last seal covers, and that belong to a tick to come.
  std::vector<AnyMessage> begun() const;

 private:
  std::vector<AnyMessage> Take(std::size_t count);

  std::vector<AnyMessage> messages_;
  std::size_t carried_ = 0;  // of messages_: of earlier seals, and of no tick of theirs
  std::int64_t last_tick_;
};

}  // namespace seam
