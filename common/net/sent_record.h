#pragma once
/// A link's records of sent datagrams, by which an ack tells which messages have arrived.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/bytes.h"

namespace seam {

/// A request to report the arrival of a message; see Link::SendUnreliable.
struct Receipt {
  int slot = 0;
  std::int64_t number = -1;
};

/// An unreliable message queued for the next Flush.
struct Passing {
  Bytes bytes;
  std::vector<Receipt> receipts;
};

/// The contents of a sent datagram.
struct SentRecord {
  std::int64_t sent_us = 0;
  std::size_t bytes = 0;
  std::int64_t total = 0;  ///< LineRate::NoteSent
  bool acked = false;
  std::vector<std::int64_t> ids;
  std::vector<Receipt> receipts;
};

}  // namespace seam
