#include "tests/lab/load/load.h"

#include <algorithm>
#include <vector>

namespace seam {
namespace {

/// Sums over the ticks of who has what.
struct Held {
  std::int64_t awake = 0, by_clients = 0, touches = 0, split = 0;

  void Add(const Replica& server) {
    const World& world = server.world();
    const auto authority = [&](int body) {
      return server.authority().at(world.mechanism(body)).authority;
    };
    for (int body = 0; body < world.body_count(); ++body) {
      if (!world.awake(body)) continue;
      ++awake;
      by_clients += authority(body) > 0 ? 1 : 0;
    }
    for (const Touch& touch : world.touches()) {
      ++touches;
      split += authority(touch.body_a) != authority(touch.body_b) ? 1 : 0;
    }
  }
};

double Ratio(double a, double b) { return b > 0 ? a / b : 0; }

}  // namespace

Load MeasureLoad(ClusterConfig config) {
  config.keep = false;
  Cluster cluster(config);
  const double seconds = config.duration_s > 0 ? config.duration_s : cluster.scene().duration_s;
  const int hz = cluster.scene().solver.tick_hz;
  const auto end = static_cast<std::int64_t>(seconds * hz);
  cluster.RunToTick(std::min<std::int64_t>(hz, end));
  const Stats begin = cluster.server().stats();
  const double server_begin_us = cluster.server_cpu_us(), client_begin_us = cluster.client_cpu_us();
  Held held;
  std::vector<double> tick_us;
  const std::int64_t first = cluster.server().tick();
  double before_us = server_begin_us;
  for (std::int64_t tick = first + 1; tick <= end; ++tick) {
    cluster.RunToTick(tick);
    tick_us.push_back(cluster.server_cpu_us() - before_us);
    before_us = cluster.server_cpu_us();
    held.Add(cluster.server().replica());
  }
  Load load;
  load.players = static_cast<int>(cluster.scene().players.size());
  load.bodies = cluster.server().replica().world().body_count();
  const auto ticks = static_cast<double>(tick_us.size());
  const double clients = load.players, span_s = ticks / hz;
  const Stats& now = cluster.server().stats();
  load.awake = Ratio(static_cast<double>(held.awake), ticks);
  load.server_us = Ratio(cluster.server_cpu_us() - server_begin_us, ticks);
  load.client_us = Ratio(cluster.client_cpu_us() - client_begin_us, ticks * clients);
  load.to_client_kbps =
      Ratio(static_cast<double>(now.bytes_out - begin.bytes_out) * 1e-3, clients * span_s);
  load.from_client_kbps =
      Ratio(static_cast<double>(now.bytes_in - begin.bytes_in) * 1e-3, clients * span_s);
  load.held_share = Ratio(static_cast<double>(held.by_clients), static_cast<double>(held.awake));
  load.split_share = Ratio(static_cast<double>(held.split), static_cast<double>(held.touches));
  std::sort(tick_us.begin(), tick_us.end());
  if (!tick_us.empty()) load.server_p99_us = tick_us[tick_us.size() * 99 / 100];
  return load;
}

}  // namespace seam
