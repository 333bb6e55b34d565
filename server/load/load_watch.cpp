#include "server/load/load_watch.h"

#include <algorithm>

#include "common/sync/moving.h"
#include "server/chronicle.h"
#include "server/load/islands.h"

namespace seam {
namespace {

std::int32_t Small(std::int64_t n) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(n, 0, INT32_MAX));
}

/// Counts the moving bodies, and those among them that a client has.
void CountMoving(const Replica& replica, Load* load) {
  const World& world = replica.world();
  load->bodies = world.body_count();
  for (int body = 0; body < world.body_count(); ++body) {
    if (!IsMoving(world, body)) continue;
    ++load->moving;
    if (replica.authority().at(world.mechanism(body)).authority != 0) ++load->moving_held;
  }
}

}  // namespace

void LoadWatch::NoteCall(const Server& server, std::int64_t begin_us, std::int64_t wall_us,
                         std::int64_t tick_before, std::int64_t due_us) {
  const std::int64_t steps = server.tick() - tick_before;
  if (steps <= 0) return;
  const std::int64_t period_us = (server.next_tick_us() - due_us) / steps;
  const std::int64_t each_us = wall_us / steps;
  session_.Add(each_us, steps);
  for (std::int64_t i = 0; i < steps; ++i) {
    const std::int64_t late_us = begin_us + i * wall_us / steps - due_us - i * period_us;
    wall_.Add(each_us);
    late_.Add(late_us);
    wall_total_.Add(each_us);
    late_total_.Add(late_us);
  }
}

Load LoadWatch::Tell(std::int64_t now_us, const Server& server) {
  Load load;
  load.utime = now_us;
  load.tick = server.tick();
  load.speed_ppm = server.speed_ppm();
  load.ticks = Small(wall_.count());
  load.tick_p50_us = Small(wall_.PercentileUs(0.5));
  load.tick_p99_us = Small(wall_.PercentileUs(0.99));
  load.tick_max_us = Small(wall_.max_us());
  load.late_p50_us = Small(late_.PercentileUs(0.5));
  load.late_p99_us = Small(late_.PercentileUs(0.99));
  load.late_max_us = Small(late_.max_us());
  load.cpu_us = cpu_us_;
  load.clients = server.client_count();
  load.players = server.player_count();
  CountMoving(server.replica(), &load);
  load.islands = server.started() ? CountIslands(server.replica().world()) : 0;
  load.hand_overs = server.chronicle().hand_overs();
  load.jumps = server.jumps();
  const Stats& stats = server.stats();
  load.dropped_malformed = stats.dropped_malformed;
  load.dropped_stale = stats.dropped_stale;
  load.dropped_right = stats.dropped_right;
  load.dropped_implausible = stats.dropped_implausible;
  load.dropped_budget = stats.dropped_budget;
  server.traffic().Write(&load);
  wall_ = late_ = DurationHistogram();
  told_us_ = now_us;
  return load;
}

}  // namespace seam
