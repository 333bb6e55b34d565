/// A very large room of real clients, in virtual time: `make soak` has a thousand, which take 10
/// GB.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/lab/load/load.h"
#include "tests/lab/relief/relief_scene.h"
#include "tests/support/soak.h"

namespace seam {
namespace thousand_cluster_test {

SessionLoad LoadOf(int players) {
  ReliefRoom room;
  room.players = players;
  room.each = 2;
  room.spacing = 20;
  room.plains = 4;
  room.things = ReliefThings::kBalls;
  room.sleep = true;
  ClusterConfig config;
  config.scene = "relief";
  config.scene_text = ReliefText(room);
  config.drive = Drive::kBot;
  config.publish = Publish::kNone;
  config.duration_s = 3;
  return MeasureLoad(config);
}

TEST(ThousandCluster, SendsToEachAsMuchAsInASmallerRoomAndItsClientsHoldWhatMoves) {
  const int players = Soak(1) > 1 ? 1000 : 128;
  const SessionLoad some = LoadOf(players / 4), all = LoadOf(players);
  EXPECT_GT(all.held_share, 0.95);
  EXPECT_GT(all.awake, 0.9 * players);
  EXPECT_LT(all.to_client_kbps, 1.25 * some.to_client_kbps);
  EXPECT_LT(all.from_client_kbps, 1.25 * some.from_client_kbps);
  std::printf("[          ] %d players: %.0f us a tick, %.1f kB/s to each; %d: %.0f, %.1f\n",
              players / 4, some.server_us, some.to_client_kbps, players, all.server_us,
              all.to_client_kbps);
}

}  // namespace thousand_cluster_test
}  // namespace seam
