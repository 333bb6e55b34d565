#include "render/playback/peer_report.h"

#include <algorithm>

namespace seam {

PeerReport ReportOf(const Recording& recording, int peer, double tick) {
  PeerReport worst;
  for (const auto& [from, list] : recording.stats) {
    if (peer != 0 && from != peer) continue;
    const Stats* last = nullptr;
    for (const Stats& stats : list)
      if (static_cast<double>(stats.tick) <= tick) last = &stats;
    if (last == nullptr) continue;
    worst.rtt_us = std::max(worst.rtt_us, last->rtt_us);
    worst.jitter_us = std::max(worst.jitter_us, last->jitter_us);
    worst.loss_percent = std::max(worst.loss_percent, last->loss_ppm * 1e-4);
  }
  return worst;
}

}  // namespace seam
