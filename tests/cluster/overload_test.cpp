/// A server that cannot keep up slows its room down for all clients: in virtual time, with ticks
/// that take twice their period.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "client/embed/cluster.h"

namespace seam {
namespace overload_test {

constexpr std::int64_t kPeriodUs = 1000000 / 60;
/// The server is overloaded from the first of these ticks to the second.
constexpr std::int64_t kFrom = 120, kUntil = 480, kEnd = 900;

/// Observations of a run.
struct Seen {
  std::int64_t worst_late_us = 0;  ///< of the server's next tick, once it had time to notice
  std::int64_t worst_wait_us = 0;  ///< between two ticks of a client
  std::int64_t worst_apart = 0;    ///< ticks between a client and the server, while overloaded
  std::int64_t overloaded_us = 0;  ///< from tick kFrom to tick kUntil
  std::int32_t least_ppm = kFullSpeedPpm, least_told_ppm = kFullSpeedPpm, last_ppm = 0;
  std::int64_t rejoins = 0;
  float worst_jump = 0;          ///< m, of a shown body from a tick to the next beyond its velocity
  int slowed = 0, restored = 0;  ///< events
};

/// Largest distance of a displayed body from the position predicted by its velocity a tick before,
/// m.
float WorstJump(const Recording& recording) {
  float worst = 0;
  for (const auto& [peer, views] : recording.views) {
    const View* before = nullptr;
    for (const auto& [tick, view] : views) {
      const bool next = before != nullptr && before->tick + 1 == tick && before->id == view.id;
      for (std::size_t i = 0; peer > 0 && next && i < view.id.size(); ++i) {
        const float speed =
            std::max(std::hypot(view.vx[i], view.vy[i]), std::hypot(before->vx[i], before->vy[i]));
        const float way = std::hypot(view.x[i] - before->x[i], view.y[i] - before->y[i]);
        worst = std::max(worst, way - speed / 60);
      }
      before = &view;
    }
  }
  return worst;
}

Seen Play(const std::string& mode, bool overloaded) {
  ClusterConfig config;
  config.scene = "crossing";
  config.mode = mode;
  config.impair = "delay=40ms,jitter=5ms";
  config.drive = Drive::kBot;
  if (overloaded) {
    config.server_tick_us = [](std::int64_t tick) {
      return tick >= kFrom && tick < kUntil ? 2 * kPeriodUs : std::int64_t{0};
    };
  }
  Cluster cluster(config);
  Seen seen;
  std::vector<std::int64_t> last_tick(2, -1), since_us(2, 0);
  std::int64_t from_us = 0;
  cluster.each_instant = [&] {
    Server& server = cluster.server();
    const std::int64_t tick = server.tick(), now_us = cluster.now_us();
    if (!server.started() || tick < 60) return;
    if (tick >= kFrom && from_us == 0) from_us = now_us;
    if (tick >= kUntil && seen.overloaded_us == 0) seen.overloaded_us = now_us - from_us;
    seen.least_ppm = std::min(seen.least_ppm, server.speed_ppm());
    if (tick >= kFrom + 60) {
      seen.worst_late_us = std::max(seen.worst_late_us, now_us - server.next_tick_us());
    }
    for (int i = 0; i < 2; ++i) {
      const Client& client = *cluster.client(i);
      const auto at = static_cast<std::size_t>(i);
      if (!client.running()) continue;
      const std::int64_t its = client.replica()->tick();
      if (its != last_tick[at]) {
        if (since_us[at] > 0) {
          seen.worst_wait_us = std::max(seen.worst_wait_us, now_us - since_us[at]);
        }
        last_tick[at] = its;
        since_us[at] = now_us;
      }
      seen.worst_apart = std::max(seen.worst_apart, std::abs(its - tick));
      seen.least_told_ppm = std::min(seen.least_told_ppm, client.speed_ppm());
    }
  };
  cluster.RunToTick(kEnd);
  seen.last_ppm = cluster.server().speed_ppm();
  for (int i = 0; i < 2; ++i) seen.rejoins += cluster.client(i)->rejoins();
  seen.worst_jump = WorstJump(cluster.recording());
  for (const Event& event : cluster.recording().events) {
    if (event.text.find("the server cannot keep up: the room runs at ") == 0) ++seen.slowed;
    if (event.text == "the room runs at full speed again") ++seen.restored;
  }
  return seen;
}

class Overload : public ::testing::TestWithParam<const char*> {};

TEST_P(Overload, TicksOfTwiceTheirPeriodSlowTheRoomForAllAndNobodyTeleports) {
  const Seen calm = Play(GetParam(), false);
  EXPECT_EQ(calm.least_ppm, kFullSpeedPpm);
  EXPECT_EQ(calm.slowed, 0);
  const Seen seen = Play(GetParam(), true);
  // The server announces it, to the clients and to the operator, and withdraws it afterwards.
  EXPECT_LT(seen.least_ppm, 550000);
  EXPECT_LT(seen.least_told_ppm, 550000);
  EXPECT_GE(seen.slowed, 1);
  EXPECT_LE(seen.slowed, 3);
  EXPECT_GT(seen.last_ppm, seen.least_ppm);
  // Six seconds of room time take twelve, and a bit for noticing.
  EXPECT_GT(seen.overloaded_us, 11000000);
  EXPECT_LT(seen.overloaded_us, 14000000);
  EXPECT_LT(seen.worst_late_us, 500000) << "the server does not fall further and further behind";
  EXPECT_LT(seen.worst_apart, 45) << "ticks; and no client leaves it behind";
  EXPECT_LT(seen.worst_wait_us, 250000) << "no client stands still";
  EXPECT_EQ(seen.rejoins, 0);
  EXPECT_LT(seen.worst_jump, 1.5f * calm.worst_jump + 0.1f);
}

INSTANTIATE_TEST_SUITE_P(Modes, Overload, ::testing::Values("buffer", "central", "strict"));

}  // namespace overload_test
}  // namespace seam
