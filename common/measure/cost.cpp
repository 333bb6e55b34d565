/// Cost of a run: bytes of clients and CPU time of peers, per second of the simulated timeline.

#include "common/measure/parts.h"

namespace seam {
namespace {

/// Returns the growth of a counter per second. Spans without a later tick or with a smaller counter
/// (a restarted peer) are ignored; nullopt when no span is left.
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

/// Returns the mean over the peers from `first_peer` on that have a rate; 0 if none has.
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
