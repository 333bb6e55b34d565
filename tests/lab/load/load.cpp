#include "tests/lab/load/load.h"

#include <algorithm>
#include <map>
#include <vector>

#include "tests/lab/session.h"

namespace seam {
namespace {

/// Sums over the ticks of who has what.
struct Held {
  std::int64_t awake = 0, stepped = 0, by_clients = 0, touches = 0, split = 0;
  std::map<int, const Replica*> holders;  // by peer

  void Add(Cluster& cluster) {
    const Replica& server = cluster.server().replica();
    FindHolders(cluster);
    const World& world = server.world();
    for (int body = 0; body < world.body_count(); ++body) {
      stepped += IsPresent(world.activity(body)) ? 1 : 0;
      const int holder = server.authority().at(world.mechanism(body)).authority;
      // The server's copy of what a client has may be absent: the client knows.
      const auto found = holders.find(holder);
      const bool known = found != holders.end() && found->second->revision() == server.revision();
      if (!(known ? found->second->world() : world).awake(body)) continue;
      ++awake;
      by_clients += holder > 0 ? 1 : 0;
    }
  }
  void FindHolders(Cluster& cluster) {
    holders.clear();
    for (int i = 0; i < cluster.client_count(); ++i) {
      const Client& client = *cluster.client(i);
      if (client.running()) holders[client.peer()] = client.replica();
    }
  }
  /// Touches of what the peer has authority over: each pair of two authorities is seen by both.
  void AddTouches(const Replica& replica, int self) {
    const World& world = replica.world();
    const auto own = [&](int body) {
      return replica.authority().at(world.mechanism(body)).authority == self;
    };
    for (const Touch& touch : world.touches()) {
      const bool a = own(touch.body_a), b = own(touch.body_b);
      touches += 2 * (a && b ? 1 : 0) + (a != b ? 1 : 0);
      split += a != b ? 1 : 0;
    }
  }
};

double Ratio(double a, double b) { return b > 0 ? a / b : 0; }

}  // namespace

SessionLoad MeasureLoad(ClusterConfig config) {
  config.keep = false;
  config.smooth_rate = 0;  // as the load tester's clients: nobody looks
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
    held.Add(cluster);
    for (int i = 0; i < cluster.client_count(); ++i) {
      const Client& client = *cluster.client(i);
      if (client.running()) held.AddTouches(*client.replica(), client.peer());
    }
  }
  RequireScripts(cluster.server());
  SessionLoad load;
  load.players = static_cast<int>(cluster.scene().players.size());
  load.bodies = cluster.server().replica().world().body_count();
  const auto ticks = static_cast<double>(tick_us.size());
  const double clients = load.players, span_s = ticks / hz;
  const Stats& now = cluster.server().stats();
  load.awake = Ratio(static_cast<double>(held.awake), ticks);
  load.stepped = Ratio(static_cast<double>(held.stepped), ticks);
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
