/// A peer whose bodies no other peer simulates steps them without barriers; one that shares a body
/// rebuilds its world at the same ticks as the others.

#include <gtest/gtest.h>

#include <string>

#include "common/sync/replica.h"

namespace seam {
namespace alone_test {

/// Boxes that tumble onto each other: another order of contacts is other bits.
const std::string kTumble = R"(
duration = 10
[[player]]
name = "ann"
[[player]]
name = "bob"
[[part]]
name = "floor"
box = [40, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "box"
box = [1, 1]
position = [-5, 0.8]
angle = 0.3
velocity = [2, 0]
repeat = {count = [8, 5], step = [1.3, 1.3]}
[[part]]
name = "disc"
circle = 0.3
position = [-4.4, 8]
velocity = [-2, 0]
repeat = {count = [8, 4], step = [1.3, 0.8]}
)";
constexpr int kTicks = 150;

/// Hash of a client that holds everything.
std::uint64_t HashOf(bool followed, int send_hz = 30) {
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.send_hz = send_hz;
  Replica client(ParseScene(kTumble, "tumble.toml"), config, 1, 0);
  AuthorityRecord record;
  record.authority = 1;
  record.epoch = 1;
  if (followed) record.secondaries.Add(2);
  for (int m = 0; m < client.authority().count(); ++m) client.authority().Set(m, record);
  client.RolesChanged();
  client.Begin();
  for (int tick = 0; tick < kTicks; ++tick) client.Step();
  return client.world().Hash();
}

std::uint64_t HashOfWorld(bool barriers) {
  World world(ParseScene(kTumble, "tumble.toml"));
  world.Barrier();  // all begin with one
  while (world.tick() < kTicks) {
    world.Step();
    if (barriers && world.tick() % BarrierEvery(60) == 0) world.Barrier();
  }
  return world.Hash();
}

TEST(SharedBarriers, AMechanismSimulatedByOnePeerStepsWithoutBarriers) {
  ASSERT_NE(HashOfWorld(false), HashOfWorld(true)) << "or this shows nothing";
  EXPECT_EQ(HashOf(false), HashOfWorld(false));
}

TEST(SharedBarriers, AFollowedMechanismHasABarrierThirtyTimesASecond) {
  EXPECT_EQ(HashOf(true), HashOfWorld(true));
}

TEST(SharedBarriers, TheRateOfStatesDoesNotMoveThem) {
  for (const int send_hz : {1, 4, 20, 60}) EXPECT_EQ(HashOf(true, send_hz), HashOfWorld(true));
}

}  // namespace alone_test
}  // namespace seam
