#include "tests/lab/rivals/rivals.h"

#include <algorithm>

#include "common/measure/preconditions.h"
#include "common/measure/screen/response.h"
#include "server/input_room.h"
#include "tests/lab/validity/loss.h"

namespace seam {
namespace {

/// A picture stands when the next one comes later than this many ticks' time after it.
constexpr double kStandsTicks = 1.5;

std::string WhyParted(Cluster& cluster) {
  const InputRoom* const room = cluster.server().input_room();
  const int parted = room != nullptr ? room->parted() : 0;
  if (parted > 0) return std::to_string(parted) + " worlds have parted";
  for (int i = 0; i < cluster.client_count(); ++i) {
    const Client& client = *cluster.client(i);
    if (!client.running() || client.rejoins() > 0) return "a client was not in the room all along";
  }
  return "";
}

}  // namespace

void MeasureFrozen(const Recording& recording, RivalFigures* figures) {
  const double h_us = 1e6 / std::max(1, recording.room.tick_hz);
  double stood_us = 0, shown_us = 0;
  for (const auto& [peer, times] : recording.view_us) {
    const auto first = times.upper_bound(0);  // tick 0 is shown long before the room starts
    if (first == times.end()) continue;
    const auto ticks = static_cast<double>(times.rbegin()->first - first->first);
    const auto us = static_cast<double>(times.rbegin()->second - first->second);
    if (peer == 0) {
      figures->speed = us > 0 ? ticks * h_us / us : 0;
      continue;
    }
    shown_us += us;
    for (auto at = std::next(first); at != times.end(); ++at) {
      const auto gap_us = static_cast<double>(at->second - std::prev(at)->second);
      if (gap_us < kStandsTicks * h_us) continue;
      stood_us += gap_us - h_us;
      figures->frozen_longest_ms = std::max(figures->frozen_longest_ms, (gap_us - h_us) * 1e-3);
    }
  }
  figures->frozen_ms_per_s = shown_us > 0 ? 1000 * stood_us / shown_us : 0;
}

RivalFigures MeasureRival(const SessionSettings& settings, const Scene& scene) {
  Cluster cluster(Configure(settings, scene));
  cluster.RunToTick(1);
  const std::int64_t begin_us = cluster.now_us();
  const double server_us = cluster.server_cpu_us(), client_us = cluster.client_cpu_us();
  cluster.Run();
  RequireScripts(cluster.server());
  RivalFigures figures;
  const double seconds = static_cast<double>(cluster.now_us() - begin_us) * 1e-6;
  figures.server_ms_per_s = (cluster.server_cpu_us() - server_us) * 1e-3 / seconds;
  figures.client_ms_per_s =
      (cluster.client_cpu_us() - client_us) * 1e-3 / seconds / std::max(1, cluster.client_count());
  figures.stepped_again = cluster.ticks_stepped_again();
  const Recording& recording = cluster.recording();
  const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
  figures.measures = Measure(recording, oracle);
  MeasureResponse(recording, oracle, &figures.measures);
  MeasureFrozen(recording, &figures);
  figures.kbps = figures.measures.bytes_per_s * 1e-3 * figures.speed;
  figures.invalid = WhyParted(cluster);
  if (figures.invalid.empty()) {
    figures.invalid = WhyNotValid(recording, oracle, figures.measures);
  }
  const ImpairProfile network = FindProfile(settings.impair);
  if (figures.invalid.empty() && LossTooSmall(network, cluster.server_net().traffic())) {
    figures.invalid = "the network lost less than its profile says";
  }
  return figures;
}

}  // namespace seam
