/// Bodies at rest out of reach are dormant, and simulated as soon as something may reach them.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/sync/edits/edit_order.h"
#include "common/sync/replica.h"

namespace seam {
namespace dormant_test {

/// Three crates in a row that nearly touch; a disc that comes by. No gravity.
std::string Row(const std::string& disc) {
  return R"(
gravity = [0, 0]
[[player]]
name = "ann"
[[player]]
name = "bob"
[[part]]
name = "crate"
box = [1, 1]
density = 0.5
repeat = {count = 3, step = [1.03, 0]}
[[part]]
name = "disc"
circle = 0.5
density = 4
)" + disc;
}
constexpr int kFirst = 0, kLast = 2, kDisc = 3;

/// The server holds everything and plans as if a player that may touch a crate were granted it.
class Room {
 public:
  explicit Room(const std::string& disc)
      : replica(ParseScene(Row(disc), "row.toml"), MakeSyncConfig("buffer", "rollback"), 0, -1) {
    for (int m = 0; m < replica.authority().count(); ++m) Give(m, 0);
    replica.RolesChanged();
    AllowDormant({});
  }
  void Give(int mechanism, int peer) {
    AuthorityRecord record = replica.authority().at(mechanism);
    record.authority = peer;
    ++record.epoch;
    replica.authority().Set(mechanism, record);
  }
  void AllowDormant(const PeerSet& uncertain) {
    replica.AllowDormant(std::vector<char>(4, 1), uncertain);
  }
  void Steps(int ticks) {
    for (int i = 0; i < ticks; ++i) replica.Step();
  }
  const World& world() const { return replica.world(); }
  Activity Of(int body) const { return world().activity(body); }
  bool There(int body) const { return IsPresent(Of(body)); }
  float x(int body) const { return world().Read(body).position.x(); }
  float speed(int body) const { return world().Read(body).velocity.norm(); }

  Replica replica;
};

constexpr int kToRest = 90;  // ticks

TEST(Dormant, ARestingCrateIsDormantWhileADiscPassesAtFiveMetres) {
  Room room("position = [-5, -4]\nvelocity = [0, 2]\n");
  room.Steps(kToRest);
  for (const int crate : {kFirst, 1, kLast}) EXPECT_EQ(room.Of(crate), Activity::kDormant) << crate;
  EXPECT_EQ(room.Of(kDisc), Activity::kSimulated) << "it moves";
  EXPECT_EQ(room.world().present().size(), 1u);
  EXPECT_FALSE(room.world().awake(kFirst));
}

/// It does as it does where all are there all the time, to the bit.
TEST(Dormant, AFastDiscFindsItPresent) {
  for (const float speed : {1.0f, 3.0f, 10.0f, 40.0f, 80.0f}) {
    const float away = std::max(8.0f, 2.5f * speed);
    const std::string disc = "position = [" + std::to_string(-away) + ", 0]\nvelocity = [" +
                             std::to_string(speed) + ", 0]\n";
    Room room(disc), all(disc);
    all.replica.AllowDormant({}, {});
    bool idle = false, struck = false;
    for (int tick = 0; tick < 600; ++tick) {
      room.Steps(1);
      all.Steps(1);
      idle = idle || !room.There(kFirst);
      struck = struck || room.speed(kLast) > 0;
      ASSERT_TRUE(all.There(kFirst));
      ASSERT_EQ(room.world().Hash(), all.world().Hash()) << speed << " m/s, tick " << tick;
    }
    EXPECT_TRUE(idle) << speed;
    EXPECT_TRUE(struck) << "the blow came through the row, " << speed << " m/s";
  }
}

TEST(Dormant, AnUnreliablePeersDiscFindsItPresent) {
  Room room("position = [-1.2, 0]\n");
  room.Give(kDisc, 1);
  room.replica.RolesChanged();
  room.Steps(kToRest);
  EXPECT_FALSE(room.There(kFirst));
  PeerSet uncertain;
  uncertain.Add(1);
  room.AllowDormant(uncertain);
  room.Steps(12);
  EXPECT_TRUE(room.There(kFirst));
  EXPECT_TRUE(room.There(kLast)) << "what it touches is, too";
  EXPECT_TRUE(room.There(kDisc));
}

TEST(Dormant, StaysAtRestWhenItReturns) {
  Room room("position = [60, 0]\n");
  room.Steps(kToRest);
  ASSERT_FALSE(room.There(kFirst));
  const BodyState lay = room.world().Read(kFirst);
  room.replica.AllowDormant({0, 0, 0, 0}, {});
  room.Steps(60);
  ASSERT_TRUE(room.There(kFirst));
  EXPECT_FALSE(room.world().awake(kFirst));
  EXPECT_EQ(room.world().Read(kFirst).position, lay.position);
  for (int body = 0; body <= kDisc; ++body) EXPECT_TRUE(room.replica.rest().Holds(body)) << body;
}

TEST(Dormant, IsPresentWhenAnEditActs) {
  Room room("position = [60, 0]\n");
  room.Steps(kToRest);
  ASSERT_FALSE(room.There(kFirst));
  BlastEdit blast;
  blast.centre = {-2, 0};
  blast.radius = 4;
  blast.impulse = 3;
  EditOrder order = ToOrder(Edit(blast));
  order.tick = room.replica.tick();
  order.number = room.replica.revision();
  ASSERT_TRUE(room.replica.Queue(order));
  room.Steps(30);
  EXPECT_GT(room.x(kFirst), 0.001f) << "pushed";
  EXPECT_GT(room.x(kLast), 2.065f) << "by the first, which hit the second";
  EXPECT_LT(room.x(kFirst), room.x(1) - 0.95f) << "it did not go through it";
}

/// Ten crates, one on the other.
const char* const kTower = R"(
[[part]]
name = "ground"
chain = [[-20, 0], [20, 0]]
[[part]]
name = "crate"
box = [0.7, 0.7]
position = [0, 0.36]
repeat = {count = 10, step = [0, 0.71]}
)";

/// Pushed by an edit, it moves to the bit as a tower that was present all the time: its contacts
/// begin with their old impulses.
TEST(Dormant, ATowerThatReturnsStandsAsBefore) {
  const auto push = [](Replica* replica) {
    PushEdit edit;
    edit.part = replica->world().id(9);
    edit.impulse = {0.02f, 0};
    EditOrder order = ToOrder(Edit(edit));
    order.tick = replica->tick();
    order.number = replica->revision();
    ASSERT_TRUE(replica->Queue(order));
  };
  const SyncConfig config = MakeSyncConfig("buffer", "rollback");
  const Scene scene = ParseScene(kTower, "tower.toml");
  Replica idle(scene, config, 0, -1), there(scene, config, 0, -1);
  for (Replica* replica : {&idle, &there}) {
    // A client follows all of it: bodies that must agree to the bit are rebuilt at the same ticks.
    AuthorityRecord followed;
    followed.secondaries.Add(1);
    for (int m = 0; m < replica->authority().count(); ++m) replica->authority().Set(m, followed);
    replica->RolesChanged();
  }
  idle.AllowDormant(std::vector<char>(10, 1), {});
  for (int tick = 0; tick < 600; ++tick) {
    idle.Step();
    there.Step();
  }
  ASSERT_TRUE(idle.world().present().empty());
  ASSERT_EQ(there.world().present().size(), 10u);
  push(&idle);
  push(&there);
  bool woken = false;
  for (int tick = 0; tick < 300; ++tick) {
    idle.Step();
    there.Step();
    woken = woken || idle.world().awake(0);
    ASSERT_EQ(idle.world().Hash(), there.world().Hash()) << tick;
  }
  EXPECT_TRUE(woken);
}

TEST(Dormant, IsHandedToAClientAndBack) {
  Room room("position = [60, 0]\n");
  room.Steps(kToRest);
  ASSERT_FALSE(room.There(kFirst));
  room.Give(kFirst, 1);
  room.replica.RolesChanged();
  room.Steps(30);
  EXPECT_EQ(room.Of(kFirst), Activity::kDisplayed) << "far from all";
  EXPECT_NEAR(room.x(kFirst), 0, 1e-6);
  room.Give(kFirst, 0);
  room.replica.RolesChanged();
  EXPECT_TRUE(room.There(kFirst)) << "until it has been committed anew";
  room.Steps(30);
  EXPECT_FALSE(room.There(kFirst));
  EXPECT_TRUE(room.replica.rest().Holds(kFirst));
  EXPECT_NEAR(room.x(kFirst), 0, 1e-6);
}

}  // namespace dormant_test
}  // namespace seam
