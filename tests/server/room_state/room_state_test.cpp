/// A room's state: a room that is saved and loaded continues.

#include "server/room_state.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "common/base/state_archive.h"
#include "server/rules/rules.h"
#include "server/sessions/place_table.h"
#include "tests/support/arena.h"
#include "tests/support/lone_room.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace room_state_test {

/// Continues a room and one that has loaded it; both must have the same bodies in every tick, and
/// in the end the same state.
void ExpectSameCourse(LoneRoom* room, std::int64_t ticks, const std::string& method = "buffer") {
  const Bytes bytes = room->Save();
  LoneRoom loaded(bytes, method);
  ASSERT_TRUE(loaded.server != nullptr) << loaded.status.why();
  for (std::int64_t i = 0; i < ticks; ++i) {
    room->Step();
    loaded.Step();
    ASSERT_EQ(loaded.Hash(), room->Hash()) << "in tick " << room->server->tick();
  }
  EXPECT_TRUE(loaded.Save() == room->Save());
  EXPECT_EQ(loaded.server->rules()->metadata().values(),
            room->server->rules()->metadata().values());
}

TEST(RoomState, ScriptsTriggersAndEditsContinue) {
  for (const std::int64_t tick : {1, 30, 49, 50, 51, 126}) {
    SCOPED_TRACE(tick);
    LoneRoom room(Arena());
    room.StepTo(tick);
    ExpectSameCourse(&room, 150);
  }
}

TEST(RoomState, ARoomIsSavedAgainAfterItWasLoaded) {
  LoneRoom room(Arena());
  room.StepTo(60);
  LoneRoom second(room.Save(), "buffer");
  ASSERT_TRUE(second.server != nullptr) << second.status.why();
  second.StepTo(140);
  ExpectSameCourse(&second, 100);
}

/// The world of such a room has, or had, a stage for what is gone by now; its saved state does not
/// say what that was.
TEST(RoomState, FeaturesThatAScriptMadeAndRemovedAreNotMissed) {
  const char* const kMade[] = {
      R"(world.weld("near", "far", 300))",
      R"(world.add_part{name = "belt", box = {2, 0.2}, position = {-60, 4}, anchored = true,
                        conveyor = 2})",
      R"(world.add_part{name = "hooked", box = {0.5, 0.5}, position = {-60, 4},
                        inlets = {{0.25, 0, 0}}})"};
  const char* const kRemoved[] = {R"(world.unweld("near", "far"))", R"(world.remove_part("near"))",
                                  R"(world.remove_part("belt"))", R"(world.remove_part("hooked"))"};
  const std::pair<int, int> pairs[] = {{0, 0}, {0, 1}, {1, 2}, {2, 3}};
  for (const auto& [made, removed] : pairs) {
    const std::string how = std::string(kMade[made]) + ", " + kRemoved[removed];
    SCOPED_TRACE(how);
    LoneRoom room(ParseScene(Arena().text + R"(
[[part]]
name = "near"
box = [0.5, 0.5]
position = [-60, 0.26]
[[part]]
name = "far"
box = [0.5, 0.5]
position = [-59.4, 0.26]
[[script]]
name = "maker"
code = '''
function on_tick()
  if world.tick() == 20 then )" + kMade[made] +
                                 R"( end
  if world.tick() == 60 then )" + kRemoved[removed] +
                                 R"( end
end
'''
)",
                             "made.toml"));
    for (const std::int64_t tick : {40, 90}) {
      room.StepTo(tick);
      EXPECT_FALSE(room.server->script_stopped());
      ExpectSameCourse(&room, 30);
    }
  }
}

TEST(RoomState, ARoomWithTheLongestSceneIsSavedAndLoaded) {
  std::string text = Arena().text + "\n#";
  text.append(kSceneTextBytesMax - text.size(), 'x');
  LoneRoom room(ParseScene(text, "arena.toml"));
  room.StepTo(30);
  ExpectSameCourse(&room, 30);
}

TEST(RoomState, ATriggerThatIsOccupiedIsNotEnteredAgain) {
  LoneRoom room(Arena());
  room.StepTo(80);
  const MetaKey health{kMetaPart, 2, kMetaHealth}, score{kMetaPlayer, 0, kMetaScore};
  const float hurt = room.server->rules()->metadata().Get(health);
  ASSERT_LT(hurt, 500) << "nothing lies in the acid";
  ASSERT_EQ(room.server->rules()->metadata().Get(score), 3) << "the gate was not passed";
  LoneRoom loaded(room.Save(), "buffer");
  ASSERT_TRUE(loaded.server != nullptr) << loaded.status.why();
  EXPECT_EQ(loaded.server->rules()->metadata().Get(health), hurt);
  loaded.StepTo(110);
  EXPECT_NEAR(loaded.server->rules()->metadata().Get(health), hurt - 30 * 10 / 60.0, 1e-2);
  EXPECT_EQ(loaded.server->rules()->metadata().Get(score), 3);
}

TEST(RoomState, APlayerOnTheWayToASeatGetsThere) {
  for (const std::int64_t tick : {25, 60, 110, 405}) {
    SCOPED_TRACE(tick);
    LoneRoom room(LoadScene("scenes/dockside.toml"));
    room.StepTo(tick);
    ExpectSameCourse(&room, 120);
  }
}

TEST(RoomState, PlacesAreReservedForTheirKeys) {
  LoneRoom room(Arena());
  room.StepTo(10);
  const auto join = [](LoneRoom* at, Guest* guest) {
    const auto tick = [&] {
      at->Step();
      guest->Flush(at->now_us);
      guest->Read(at->now_us);
    };
    guest->SayHello();
    tick();
    for (int i = 0; i < 5; ++i) {  // one Join has not earned a long refusal
      if (!guest->welcomed && guest->refusal.empty()) guest->SayJoin();
      tick();
    }
  };
  Guest bob(&room.network, 5001, "bob");
  join(&room, &bob);
  ASSERT_TRUE(bob.welcomed) << bob.refusal;
  bob.link.SendReliable(Encode(Ready()));
  bob.Flush(room.now_us);
  for (int i = 0; i < 5; ++i) room.Step();
  LoneRoom loaded(room.Save(), "buffer");
  ASSERT_TRUE(loaded.server != nullptr) << loaded.status.why();
  Guest thief(&loaded.network, 5002, "bob"), owner(&loaded.network, 5003, "bob");
  join(&loaded, &thief);
  EXPECT_FALSE(thief.welcomed);
  EXPECT_NE(thief.refusal.find("the name bob is in use"), std::string::npos) << thief.refusal;
  owner.key = bob.key;
  join(&loaded, &owner);
  EXPECT_TRUE(owner.welcomed) << owner.refusal;
}

/// ann's region is left of x = 0, bob's right of it.
constexpr const char* kTwoSides = R"(
gravity = [0, 0]
[[part]]
name = "ball"
circle = 0.5
position = [-4, 0]
velocity = [20, 0]
[[player]]
name = "ann"
region = [[-100, -100], [-0.001, 100]]
[[player]]
name = "bob"
region = [[0, -100], [100, 100]]
)";

TEST(RoomState, ThePresentAloneIsMuchSmallerAndGoesOnAlike) {
  const Scene scene = LoadScene("scenes/gas.toml");  // 200 discs that never rest
  const SyncConfig config = MakeSyncConfig({"buffer", "rollback", ""});
  const auto saved = [&](Replica* replica, Replica::Past past) {
    StateArchive to;
    replica->Persist(to, past);
    return to.Take();
  };
  Replica replica(scene, config, 0, -1);
  while (replica.tick() < 240) replica.Step();
  const Bytes all = saved(&replica, Replica::Past::kAll);
  const Bytes present = saved(&replica, Replica::Past::kNone);
  std::printf("200 discs: %zu bytes, with the past %zu\n", present.size(), all.size());
  EXPECT_LT(present.size(), all.size() / 6);
  for (const Bytes& bytes : {all, present}) {
    Replica loaded(scene, config, 0, -1);
    StateArchive from(bytes);
    loaded.Persist(from, Replica::Past::kAll);
    ASSERT_TRUE(from.ok()) << from.status().why();
    EXPECT_EQ(from.left(), 0U);
    Replica same(scene, config, 0, -1);
    StateArchive again(all);
    same.Persist(again, Replica::Past::kAll);
    for (int i = 0; i < 60; ++i) {
      loaded.Step();
      same.Step();
    }
    EXPECT_EQ(loaded.PastHash(300), same.PastHash(300));
  }
}

TEST(RoomState, APlayerKeepsWhatItHasForTheDwellTime) {
  const Scene scene = ParseScene(kTwoSides, "sides.toml");
  const SyncConfig config = MakeSyncConfig({"buffer", "", ""});
  AuthorityManager::PlannerInputs inputs;
  inputs.peer_of_player = {1, 2};
  // Returns the ticks after which grants were made, from `tick` on.
  const auto run = [&](Replica* replica, AuthorityManager* manager, std::int64_t until) {
    std::vector<std::pair<std::int64_t, int>> grants;
    while (replica->tick() < until) {
      replica->Step();
      for (const Grants& each : manager->Update(replica->tick() * 16667, inputs)) {
        grants.emplace_back(replica->tick(), each.authority.at(0));
      }
    }
    return grants;
  };
  for (const std::int64_t saved_at : {10, 20, 28}) {  // ann has had it since tick 0
    Replica replica(scene, config, 0, -1);
    AuthorityManager manager(scene, config, replica);
    manager.Update(0, inputs);
    run(&replica, &manager, saved_at);
    StateArchive to;
    replica.Persist(to, Replica::Past::kAll);
    manager.Persist(to);
    const Bytes bytes = to.Take();
    Replica loaded(scene, config, 0, -1);
    AuthorityManager again(scene, config, loaded);
    StateArchive from(bytes);
    loaded.Persist(from, Replica::Past::kAll);
    again.Persist(from);
    ASSERT_TRUE(from.ok()) << from.status().why();
    EXPECT_EQ(loaded.authority().at(0).authority, replica.authority().at(0).authority);
    EXPECT_EQ(loaded.authority().at(0).epoch, replica.authority().at(0).epoch);
    // The ball is 2 m beyond the border in tick 18, and may leave ann after 30 ticks.
    const auto grants = run(&replica, &manager, 60);
    ASSERT_FALSE(grants.empty());
    EXPECT_GE(grants.front().first, 30);
    EXPECT_EQ(run(&loaded, &again, 60), grants) << saved_at;
  }
}

TEST(RoomState, TheServerTakesBackPeersMechanismsInALaterEpoch) {
  LoneRoom room(ParseScene(kTwoSides, "sides.toml"));
  room.StepTo(20);
  AuthorityRecord record = room.server->replica().authority().at(0);
  record.authority = 1;
  record.epoch = 7;
  ServerTestAccess::ReplicaOf(*room.server).authority().Set(0, record);
  LoneRoom loaded(room.Save(), "buffer");
  ASSERT_TRUE(loaded.server != nullptr) << loaded.status.why();
  EXPECT_EQ(loaded.server->replica().authority().at(0).authority, 0);
  EXPECT_EQ(loaded.server->replica().authority().at(0).epoch, 8);
  loaded.StepTo(60);
}

TEST(RoomState, ARoomOfOtherSettingsIsRefused) {
  LoneRoom room(Arena());
  room.StepTo(5);
  const Bytes bytes = room.Save();
  LoneRoom other(bytes, "buffer/fade");
  ASSERT_TRUE(other.server == nullptr);
  EXPECT_EQ(other.status.why(), "the room was saved with other settings or another scene");
}

}  // namespace room_state_test
}  // namespace seam
