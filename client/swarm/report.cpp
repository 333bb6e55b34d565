#include "client/swarm/report.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

namespace seam {
namespace {

double Ms(std::int64_t us) { return static_cast<double>(us) * 1e-3; }

template <class... Args>
std::string Line(const char* format, Args... args) {
  char text[256];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

/// First and last load of a room.
struct Heard {
  Load first, last;
  double seconds() const { return static_cast<double>(last.utime - first.utime) * 1e-6; }
};

/// Returns the counts of all rooms, between the first and the last load of each.
BucketHistogram Counted(const ServerLoads& told, BucketHistogram RoomLoad::*of) {
  std::map<std::string, std::pair<BucketHistogram, BucketHistogram>> rooms;  // first and last
  for (const auto* loads : {&told.before, &told.meanwhile, &told.after}) {
    for (const RoomLoad& load : *loads) {
      rooms.try_emplace(load.room, load.*of, load.*of).first->second.second = load.*of;
    }
  }
  BucketHistogram all;
  for (const auto& [room, counts] : rooms) all.Add(counts.second.Since(counts.first));
  return all;
}

/// Returns "3.10 ms, ", to precede the worst second's value; "" without counts.
std::string P99(const BucketHistogram& counted) {
  return counted.count > 0 ? Line("%.2f ms, ", counted.QuantileUs(0.99) * 1e-3) : "";
}

}  // namespace

std::string ServerReport(const ServerLoads& told) {
  if (told.meanwhile.empty()) {
    return "server: not heard (--metrics HOST:PORT of a server with --metrics, or a bus)\n";
  }
  std::map<std::string, Heard> rooms;
  Load worst;
  std::vector<std::int32_t> medians;
  std::int32_t slowest = kFullSpeedPpm;
  double moving = 0, held = 0;
  for (const RoomLoad& heard : told.meanwhile) {
    const Load& load = heard.load;
    const auto [found, fresh] = rooms.try_emplace(heard.room, Heard{load, load});
    if (!fresh) found->second.last = load;
    medians.push_back(load.tick_p50_us);
    worst.tick_p99_us = std::max(worst.tick_p99_us, load.tick_p99_us);
    worst.tick_max_us = std::max(worst.tick_max_us, load.tick_max_us);
    worst.late_p50_us = std::max(worst.late_p50_us, load.late_p50_us);
    worst.late_p99_us = std::max(worst.late_p99_us, load.late_p99_us);
    worst.late_max_us = std::max(worst.late_max_us, load.late_max_us);
    slowest = std::min(slowest, load.speed_ppm);
    moving += load.moving;
    held += load.moving_held;
  }
  std::nth_element(medians.begin(),
                   medians.begin() + static_cast<std::ptrdiff_t>(medians.size() / 2),
                   medians.end());
  double cpu = 0, seconds = 0;
  for (const auto& [room, heard] : rooms) {
    cpu += static_cast<double>(heard.last.cpu_us - heard.first.cpu_us) * 1e-6;
    seconds = std::max(seconds, heard.seconds());
  }
  std::string text =
      Line("server: tick p50 %.2f ms, p99 %s%.2f ms in the worst second, max %.2f ms\n",
           Ms(medians[medians.size() / 2]), P99(Counted(told, &RoomLoad::tick)).c_str(),
           Ms(worst.tick_p99_us), Ms(worst.tick_max_us));
  text += Line("server lateness: p50 %.2f ms, p99 %s%.2f ms in the worst second, max %.2f ms\n",
               Ms(worst.late_p50_us), P99(Counted(told, &RoomLoad::late)).c_str(),
               Ms(worst.late_p99_us), Ms(worst.late_max_us));
  text +=
      Line("server room: %zu room(s), slowest clock %.0f %%, clients hold %.1f %% of what moves\n",
           rooms.size(), slowest * 1e-4, moving > 0 ? 100 * held / moving : 0.0);
  if (seconds > 0)
    text += Line("server cpu: %.2f %% of a core in its rooms\n", 100 * cpu / seconds);
  return text;
}

std::string SwarmReport(const Swarm& swarm, const ServerLoads& told) {
  const MemberFigures figures = swarm.Figures();
  const Swarm::Traffic traffic = swarm.TrafficOfAll();
  const MovingBodies moving = swarm.Moving();
  const double seconds = std::max(1e-9, swarm.measured_s());
  const double each = seconds * std::max(1, swarm.client_count()) * 1000;  // bytes -> kB/s
  std::string text =
      Line("swarm: %d client(s) in %d room(s), scene %s, mode %s, %.1f s\n", swarm.client_count(),
           swarm.room_count(), swarm.room().scene_name.c_str(), swarm.room().mode.c_str(), seconds);
  text += Line("client lateness: p50 %.2f ms, p99 %.2f ms, max %.2f ms of %lld ticks\n",
               Ms(figures.late.PercentileUs(0.5)), Ms(figures.late.PercentileUs(0.99)),
               Ms(figures.late.max_us()), static_cast<long long>(figures.ticks));
  text += Line("client tick: p50 %.3f ms, p99 %.3f ms, max %.3f ms of CPU\n",
               Ms(figures.tick_cost.PercentileUs(0.5)), Ms(figures.tick_cost.PercentileUs(0.99)),
               Ms(figures.tick_cost.max_us()));
  text += Line("client cpu: %.1f us a tick with its datagrams, %.1f %% of a core for all\n",
               static_cast<double>(figures.cpu_us) /
                   static_cast<double>(std::max<std::int64_t>(1, figures.ticks)),
               100 * swarm.cpu_s() / seconds);
  text += Line("client load: %.2f %% of its time, worst %.2f %%\n", 100 * traffic.load_mean,
               100 * traffic.load_worst);
  text += Line("client bytes: in %.2f kB/s, out %.2f kB/s each\n", traffic.bytes_in / each,
               traffic.bytes_out / each);
  text += Line(
      "client network: loss %.2f %%, worst %.2f %%; round trip %.2f ms, worst %.2f ms; "
      "%lld rejoin(s)\n",
      100 * traffic.loss_mean, 100 * traffic.loss_worst, 1000 * traffic.rtt_mean_s,
      1000 * traffic.rtt_worst_s, static_cast<long long>(traffic.rejoins));
  text += Line("moving: clients hold %.1f %% of %.1f moving bodies\n", 100 * moving.share(),
               moving.held + moving.server);
  return text + ServerReport(told);
}

}  // namespace seam
