#pragma once
/// Peers' reports about their network, once a second.

#include <cstdint>

#include "common/record/recording.h"

namespace seam {

/// The last report up to a moment. Peer 0 has no network of its own: the worst value of any client.
struct PeerReport {
  std::int32_t rtt_us = -1;     ///< least round trip of the last window, us; -1 unknown
  std::int32_t jitter_us = -1;  ///< us; nine of ten round trips exceed rtt_us by less; -1 unknown
  double loss_percent = -1;     ///< datagrams lost on the way in; -1 unknown
};

PeerReport ReportOf(const Recording& recording, int peer, double tick);

}  // namespace seam
