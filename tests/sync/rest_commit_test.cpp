/// RestCommit in one peer: commits, holds and wake-ups.

#include "common/sync/rest/rest_commit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "common/codec/validate.h"
#include "common/scene/scene.h"
#include "common/sync/blend/distrusted_rest.h"

namespace seam {
namespace rest_commit_test {

/// Two boxes side by side on the ground; this is peer 0, which holds them all at first.
class OnTheGround {
 public:
  explicit OnTheGround(const char* rule = "retrospect") : config(MakeSyncConfig("buffer", rule)) {
    world->SetAwake(0, false);
    world->SetAwake(1, false);
  }
  void Step() {
    rest.BeforeStep();
    world->Step();
    memory.RecordContacts(roles.table());
    if (config.policy->SendsCompleteTicks()) reach.Look();
    rest.AfterStep();
    memory.Record();
  }
  /// Steps `ticks` times; returns the commits.
  std::vector<Rest> Steps(int ticks) {
    std::vector<Rest> all;
    for (int i = 0; i < ticks; ++i) {
      Step();
      for (const Rest& one : rest.Take()) all.push_back(one);
    }
    return all;
  }
  void Give(int body, int peer) {
    AuthorityRecord record = roles.table().at(world->mechanism(body));
    record.authority = peer;
    record.epoch += 1;
    record.secondaries.Add(0);
    roles.table().Set(world->mechanism(body), record);
  }
  /// Another peer's message that a box rests at x, after this tick.
  Rest Lies(int body, float x) {
    Rest told;
    told.peer = 1;
    told.tick = world->tick();
    told.id = {world->id(body)};
    told.epoch = {1};
    told.x = {x};
    told.y = {0.5f};
    told.angle = {0};
    return told;
  }

  std::unique_ptr<World> world = std::make_unique<World>(ParseScene(R"(
[[part]]
name = "floor"
box = [80, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "box"
box = [1, 1]
position = [0, 0.5]
repeat = {count = 2, step = [5, 0]}
)",
                                                                    "test.toml"));
  SyncConfig config;
  BodyTable bodies{*world};
  Roles roles{config, 0, -1, *world, bodies};
  BodyMemory memory{config, *world, bodies};
  Activities activities{config, *world, roles, memory};
  Display display{config, *world, memory, activities};
  std::vector<InputTrack> inputs;
  Drivers drivers{*world, roles};
  Reach reach{config, *world, roles, drivers, inputs};
  std::unique_ptr<RestCommit> made =
      MakeRestCommit(config, *world, roles, drivers, memory, display, inputs, reach);
  RestCommit& rest = *made;
};

TEST(RestCommit, CommitsAQuarterOfASecondAfterFallingAsleepAndOnce) {
  OnTheGround room;
  EXPECT_TRUE(room.Steps(14).empty());
  const std::vector<Rest> told = room.Steps(20);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].id.size(), 2u);
  EXPECT_EQ(told[0].x[1], room.world->Read(1).position.x()) << "bit for bit";
  EXPECT_TRUE(room.rest.all());
  EXPECT_TRUE(room.Steps(300).empty());
}

TEST(RestCommit, TheHashDependsOnThePosesAtRestAlone) {
  OnTheGround one, other;
  EXPECT_EQ(one.rest.Hash(), 0u);
  one.Steps(30);
  other.Steps(90);
  EXPECT_NE(one.rest.Hash(), 0u);
  EXPECT_EQ(one.rest.Hash(), other.rest.Hash());
  OnTheGround third;
  BodyState moved = third.world->Read(1);
  moved.position.x() = std::nextafter(moved.position.x(), 10.0f);
  third.world->Write(1, moved, false);
  third.Steps(30);
  EXPECT_NE(third.rest.Hash(), one.rest.Hash());
}

TEST(RestCommit, WritesTheAuthoritysPoseAndHoldsItAgainstSmallPushes) {
  OnTheGround room;
  room.Give(1, 1);
  room.Steps(30);
  room.rest.Receive(room.Lies(1, 5.25f));
  EXPECT_TRUE(room.rest.Holds(1));
  for (int tick = 0; tick < 60; ++tick) {
    room.world->SetAwake(1, true);
    room.Step();
    EXPECT_EQ(room.world->Read(1).position.x(), 5.25f) << tick;
    EXPECT_FALSE(room.world->awake(1)) << tick;
  }
}

TEST(RestCommit, AStruckCopyReturnsIfItsAuthoritySendsNothing) {
  OnTheGround room;
  room.Give(1, 1);
  room.rest.Receive(room.Lies(1, 5.25f));
  BodyState struck = room.world->Read(1);
  struck.velocity = Vec2(2, 0);
  room.world->Write(1, struck);
  room.Steps(30);
  EXPECT_FALSE(room.rest.Holds(1));
  EXPECT_GT(room.world->Read(1).position.x(), 5.3f);
  room.Steps(30);
  EXPECT_TRUE(room.rest.Holds(1));
  EXPECT_EQ(room.world->Read(1).position.x(), 5.25f);
}

TEST(RestCommit, ANewerStateEndsItAndAnOlderRestDoesNotRestoreIt) {
  OnTheGround room;
  room.Give(1, 1);
  const Rest then = room.Lies(1, 5.25f);
  room.rest.Receive(then);
  room.Steps(3);
  room.memory.track(1).heard_tick = room.world->tick();
  room.Steps(1);
  EXPECT_FALSE(room.rest.Holds(1));
  room.rest.Receive(then);
  EXPECT_FALSE(room.rest.Holds(1));
}

TEST(RestCommit, TheNextAuthoritysRestCountsDespiteTheLastOnesFasterClock) {
  OnTheGround room;
  room.Give(1, 1);
  const Rest early = room.Lies(1, 5.25f);
  room.Steps(10);
  room.memory.track(1).heard_tick = 8;
  room.memory.track(1).heard_epoch = 1;
  room.rest.Receive(early);
  EXPECT_FALSE(room.rest.Holds(1)) << "of the same epoch, and older";
  room.Give(1, 2);
  Rest next = early;
  next.tick = 6;
  next.epoch = {2};
  room.rest.Receive(next);
  EXPECT_TRUE(room.rest.Holds(1));
}

TEST(RestCommit, ARepetitionHasTheCurrentTick) {
  OnTheGround room;
  room.Steps(100);
  ASSERT_EQ(room.rest.Everything().size(), 1u);
  EXPECT_LT(room.rest.Everything()[0].tick, 40);
  const RestBlock all = RestBlock::Of(2, 0);
  ASSERT_EQ(room.rest.Again(all, 0).size(), 1u);
  EXPECT_EQ(room.rest.Again(all, 0)[0].tick, 100);
  const std::uint32_t both = room.rest.HashOf(all, -1);
  EXPECT_EQ(both, static_cast<std::uint32_t>(room.rest.Hash()));
  EXPECT_EQ(room.rest.HashOf(all, 0), both);
  room.Give(0, 1);
  EXPECT_EQ(room.rest.Again(all, 0)[0].id.size(), 1u) << "its own";
  EXPECT_EQ(room.rest.Again(all, -1)[0].id.size(), 2u);
  EXPECT_EQ(room.rest.HashOf(all, 0) + room.rest.HashOf(all, 1), both);
  EXPECT_TRUE(room.rest.Again({2, 1}, 1).empty()) << "the other block";
  EXPECT_TRUE(room.rest.Again({2, 0}, 0).empty());
}

TEST(RestCommit, AWokenCopyReturnsToARestThatArrivesLater) {
  OnTheGround room("rollback");
  room.Give(1, 1);
  room.Steps(5);
  const Rest told = room.Lies(1, room.world->Read(1).position.x());
  BodyState struck = room.world->Read(1);
  struck.velocity = Vec2(2, 0);
  room.world->Write(1, struck);
  room.Steps(3);
  room.rest.Receive(told);
  EXPECT_FALSE(room.rest.Holds(1)) << "it goes on";
  EXPECT_TRUE(room.rest.record(1).committed) << "and is known to rest at its authority";
  EXPECT_GT(room.world->Read(1).position.x(), told.x[0]);
  room.Steps(150);
  EXPECT_TRUE(room.rest.Holds(1));
  EXPECT_EQ(room.world->Read(1).position.x(), told.x[0]);
}

TEST(RestCommit, ANewAuthorityCommitsARestingMechanismUnderItsEpoch) {
  OnTheGround room;
  room.Steps(30);
  room.Give(1, 1);
  room.Give(1, 0);
  const std::vector<Rest> told = room.Steps(2);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].epoch, std::vector<std::int32_t>{2});
}

TEST(RestCommit, ABodyHandedOverAtRestStaysAtRestAndAMovingOneDoesNot) {
  for (const float moves : {0.0f, 0.001f}) {
    OnTheGround room;
    room.Give(1, 1);
    room.Steps(30);
    room.rest.Receive(room.Lies(1, 5.25f));
    const std::uint64_t known = room.rest.Hash();
    room.Steps(20);
    ExactStates exact;
    exact.tick = room.world->tick();
    exact.id = {room.world->id(1)};
    exact.epoch = {2};
    exact.x = {5.25f};
    exact.y = {0.5f};
    exact.angle = exact.vy = exact.spin = {0};
    exact.vx = {moves};
    room.memory.track(1).heard_tick = exact.tick;
    room.rest.ProlongHandedOver(exact);
    room.Step();
    EXPECT_EQ(room.rest.Holds(1), moves == 0);
    EXPECT_EQ(room.rest.Hash() == known, moves == 0);
  }
}

TEST(RestCommit, AMovedOwnBodyWakesAndIsCommittedAnew) {
  OnTheGround room;
  room.Steps(30);
  BodyState moving = room.world->Read(0);
  moving.velocity = Vec2(1, 0);
  room.world->Write(0, moving);
  room.Steps(2);
  EXPECT_FALSE(room.rest.Holds(0));
  EXPECT_TRUE(room.world->awake(0));
  EXPECT_TRUE(room.rest.Holds(1));
  const std::vector<Rest> told = room.Steps(240);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_GT(told[0].x[0], 0.01f);
}

/// A client that joins late, or was stopped, steps many times before it sends: a body that had come
/// to rest twice was sent twice in one message, which is invalid, and the client ended.
TEST(RestCommit, ABodyThatRestsTwiceBeforeASendIsSentOnce) {
  OnTheGround room;
  for (int i = 0; i < 40; ++i) room.Step();
  ASSERT_TRUE(room.rest.all());
  BodyState moving = room.world->Read(0);
  moving.velocity = Vec2(1, 0);
  room.world->Write(0, moving);
  room.Step();
  room.Step();
  ASSERT_FALSE(room.rest.Holds(0));
  for (int i = 0; i < 240; ++i) room.Step();
  ASSERT_TRUE(room.rest.all());
  std::vector<PartId> ids;
  for (const Rest& told : room.rest.Take()) {
    EXPECT_TRUE(Valid(told));
    ids.insert(ids.end(), told.id.begin(), told.id.end());
  }
  EXPECT_EQ(ids.size(), 2u) << "each once, as it lies now";
}

}  // namespace rest_commit_test
}  // namespace seam
