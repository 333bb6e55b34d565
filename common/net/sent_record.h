#pragma once
/// What a link remembers of what it sends: to know by an acknowledgement what has arrived.

#include <cstdint>
#include <vector>

#include "common/base/bytes.h"

namespace seam {

/// Asks whether a message arrived: Link::SendUnreliable.
struct Receipt {
  int slot = 0;
  std::int64_t number = -1;
};

/// An unreliable message that waits for a Flush.
struct Passing {
  Bytes bytes;
  std::vector<Receipt> receipts;
};

/// What a datagram carried.
struct SentRecord {
  std::int64_t sent_us = 0;
  bool acked = false;
  std::vector<std::int64_t> ids;
  std::vector<Receipt> receipts;
};

}  // namespace seam
