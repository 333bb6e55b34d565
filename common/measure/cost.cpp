/// What a run cost: bytes of clients, CPU time of peers, per second of the simulated timeline.

#include "common/measure/parts.h"

namespace seam {
namespace {

/// Growth of a counter per second. Only spans in which ticks went on and the counter did not fall
/// back (a peer that started again) count; nullopt when there is none.
template <class Counter>
std::optional<double> PerSecond(const std::vector<Stats>& stats, double h, const Counter& counter) {
  std::int64_t grown = 0, ticks = 0;
  for (std::size_t i = 1; i < stats.size(); ++i) {
    const std::int64_t more = counter(stats[i]) - counter(stats[i - 1]);
    if (stats[i].tick <= stats[i - 1].tick || more < 0) continue;
    grown += more;
    ticks += stats[i].tick - stats[i - 1].tick;
  }
  if (ticks == 0) return std::nullopt;
  return static_cast<double>(grown) / (static_cast<double>(ticks) * h);
}

/// Mean over the peers from `first_peer` on that have a rate.
template <class Counter>
double MeanRate(const Recording& recording, int first_peer, const Counter& counter) {
  double sum = 0;
  int count = 0;
  for (const auto& [peer, stats] : recording.stats) {
    if (peer < first_peer) continue;
    const std::optional<double> rate = PerSecond(stats, TickSeconds(recording), counter);
    if (!rate) continue;
    sum += *rate;
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

}  // namespace

void MeasureCost(const Recording& recording, Measures* measures) {
  measures->bytes_per_s =
      MeanRate(recording, 1, [](const Stats& s) { return s.bytes_in + s.bytes_out; });
  measures->sent_bytes_per_s = MeanRate(recording, 1, [](const Stats& s) { return s.bytes_out; });
  measures->cpu_us_per_s = MeanRate(recording, 0, [](const Stats& s) { return s.cpu_us; });
}

}  // namespace seam
