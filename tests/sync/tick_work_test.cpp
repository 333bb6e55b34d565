/// A client's tick does work only for relevant bodies, in a room of any size.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "common/sync/quantize.h"
#include "common/sync/replica.h"
#include "tests/support/allocations/count_allocations.h"

namespace seam {
namespace tick_work_test {

/// The own box, one beside it in contact, and the server's distant boxes. No view is published.
std::unique_ptr<Replica> RoomOf(int far, const std::string& more = "") {
  const std::string text =
      "gravity = [0, 0]\nbounds = [[-1000, -1000], [9000, 1000]]\n"
      "[[player]]\nname = \"ann\"\nvehicle = \"own\"\n"
      "[[part]]\nname = \"own\"\nbox = [1, 1]\n"
      "[[part]]\nname = \"beside\"\nbox = [1, 1]\nposition = [1.1, 0]\n"
      "[[part]]\nname = \"far\"\nbox = [1, 1]\nposition = [300, 0]\nvelocity = [0.5, 0]\n"
      "repeat = {count = " +
      std::to_string(far) + ", step = [3, 0]}\n" + more;
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.shows_far = false;
  auto replica = std::make_unique<Replica>(ParseScene(text, "room.toml"), config, 1, 0);
  AuthorityRecord own;
  own.authority = 1;
  own.epoch = 1;
  replica->authority().Set(0, own);
  replica->RolesChanged();
  return replica;
}

/// Number of bodies that ticks process in two seconds, once distant ones are parked.
std::int64_t Looks(int far) {
  const std::unique_ptr<Replica> replica = RoomOf(far);
  for (int tick = 0; tick < 60; ++tick) replica->Step();
  EXPECT_EQ(replica->world().present().size(), 2u) << "the box beside is prescribed";
  const std::int64_t before = replica->world().looks();
  for (int tick = 0; tick < 120; ++tick) replica->Step();
  return replica->world().looks() - before;
}

TEST(TickWork, DoesNotGrowWithDistantBodies) {
  const std::int64_t few = Looks(10);
  EXPECT_GT(few, 0);
  EXPECT_EQ(Looks(2000), few);
}

/// Bytes that a tick asks for, of a room in which the own box has a wheel.
double BytesWithJoint(int far) {
  const std::unique_ptr<Replica> replica = RoomOf(
      far,
      "[[part]]\nname = \"wheel\"\ncircle = 0.2\nposition = [0, -0.8]\nspin = 3\n"
      "[[joint]]\nname = \"axle\"\nkind = \"wheel\"\na = \"own\"\nb = \"wheel\"\nfrequency = 5\n");
  for (int tick = 0; tick < 60; ++tick) replica->Step();
  EXPECT_EQ(replica->world().present().size(), 3u);
  constexpr int kTicks = 240;
  const std::size_t before = AllocatedBytes();
  for (int tick = 0; tick < kTicks; ++tick) replica->Step();
  return static_cast<double>(AllocatedBytes() - before) / kTicks;
}

/// The exact solver is rebuilt at every barrier, for the present bodies.
TEST(TickWork, DistantBodiesTakeNoMemoryBesideJoints) {
  const double few = BytesWithJoint(10), many = BytesWithJoint(2010);
  EXPECT_GT(few, 0);
  EXPECT_LT((many - few) / 2000, 8) << "a number for each, at every second tick";
}

TEST(TickWork, ADistantBodyBecomesPresentIfItsAuthorityPlacesItNear) {
  const std::unique_ptr<Replica> replica = RoomOf(500);
  for (int tick = 0; tick < 60; ++tick) replica->Step();
  constexpr int kFirst = 2;  // of the far ones
  ASSERT_EQ(replica->world().activity(kFirst), Activity::kParked);
  WireBody body = Quantise({{0, 1.6f}, 0, {0, -2}, 0});
  body.id = replica->world().id(kFirst);
  States header;
  header.tick = replica->tick();
  header.composition = static_cast<std::int64_t>(replica->world().composition().hash);
  for (const States& packed : Pack(header, {body})) replica->Receive(packed);
  for (int tick = 0; tick < 12; ++tick) replica->Step();
  EXPECT_EQ(replica->world().activity(kFirst), Activity::kPrescribed) << "it may touch the own box";
  EXPECT_NEAR(replica->world().Read(kFirst).position.y(), 1.6 - 2 * 12.0 / 60, 0.1);
}

}  // namespace tick_work_test
}  // namespace seam
