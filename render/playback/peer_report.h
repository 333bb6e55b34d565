#pragma once
/// What peers said of their network, once a second.

#include <cstdint>

#include "common/record/recording.h"

namespace seam {

/// The last report by a moment. Peer 0 has no network of its own: the worst of its clients' each.
struct PeerReport {
  std::int32_t rtt_us = -1;     ///< least round trip of the last window, us; -1 unknown
  std::int32_t jitter_us = -1;  ///< nine of ten round trips exceeded it by no more, us; -1 unknown
  double loss_percent = -1;     ///< datagrams lost on the way in; -1 unknown
};

PeerReport ReportOf(const Recording& recording, int peer, double tick);

}  // namespace seam
