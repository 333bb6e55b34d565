/// A very large room of real clients, in virtual time: `make soak` has a thousand, which take 10
/// GB.

#include <gtest/gtest.h>

#include <cstdio>

#include "server/broadcast.h"
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
  const bool soak = Soak(1) > 1;
  const int players = soak ? 1000 : 192, fewer = soak ? 256 : 96;
  const SessionLoad some = LoadOf(fewer), all = LoadOf(players);
  EXPECT_GT(all.held_share, 0.95);
  EXPECT_GT(all.awake, 0.9 * players);
  // Of the bodies out of interest each is told so many a second, however large the room.
  constexpr double kDistantKbps = 0.02 * Broadcast::kDistantPerSecond;
  EXPECT_LT(all.to_client_kbps, some.to_client_kbps + kDistantKbps);
  EXPECT_LT(all.from_client_kbps, 1.25 * some.from_client_kbps);
  std::printf("[          ] %d players: %.0f us a tick, %.1f kB/s to each; %d: %.0f, %.1f\n", fewer,
              some.server_us, some.to_client_kbps, players, all.server_us, all.to_client_kbps);
}

}  // namespace thousand_cluster_test
}  // namespace seam
