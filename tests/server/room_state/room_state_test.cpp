/// A room's state: what is saved is continued, and damaged bytes are refused.

#include "server/room_state.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <string>
#include <utility>

#include "common/base/random.h"
#include "common/base/state_archive.h"
#include "server/rules/rules.h"
#include "server/sessions/place_table.h"
#include "tests/support/lone_room.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace room_state_test {

using Clock = std::chrono::steady_clock;

/// A puck that lies in acid, another that runs into a gate and a wall, a charge, and a script that
/// counts in `room`, draws random numbers and makes parts.
constexpr const char* kArena = R"(
title = "Arena"
gravity = [0, -10]
[[player]]
name = "ann"
vehicle = "runner"
[[player]]
name = "bob"
[[part]]
name = "ground"
box = [80, 1]
position = [0, -0.5]
anchored = true
[[part]]
name = "runner"
circle = 0.4
position = [-9, 0.4]
velocity = [4, 0]
owner = "ann"
health = 100
[[part]]
name = "lying"
circle = 0.3
position = [3, 0.3]
density = 2
health = 500
[[part]]
name = "crate"
box = [0.6, 0.6]
position = [6, 0.3]
repeat = {count = [1, 4], step = [0, 0.6]}
[[trigger]]
name = "acid"
kind = "hazard"
position = [3, 0.5]
box = [2, 2]
health = 10
[[trigger]]
name = "gate"
kind = "area"
position = [-6, 0.5]
box = [1, 3]
score = 3
once = true
[[script]]
name = "keeper"
code = '''
room.count = room.count or 0
room.made = room.made or {}
if not room.begun then
  room.begun = true
  world.add_part{name = "first", circle = 0.2, position = {-12, 0.2}}
end
local forgotten = 0

function on_tick()
  forgotten = forgotten + 1
  room.count = room.count + 1
  room.half = room.count / 2
  if room.count % 25 == 0 then
    local name = "made" .. room.count
    room.made[#room.made + 1] = {name = name, by = {"keeper", room.count}, good = true}
    world.add_part{name = name, box = {0.3, 0.3}, position = {-3 + 6 * math.random(), 4}}
  end
  if room.count % 10 == 0 then world.impulse("lying", math.random() - 0.5, 1) end
  if room.count == 40 then world.weld("crate.0.0", "crate.0.1") end
end

function on_trigger(trigger, part, entered)
  room[trigger .. (entered and " in" or " out")] = (room[trigger] or 0) + 1
end
'''
)";

Scene Arena() { return ParseScene(kArena, "arena.toml"); }

/// Continues a room and one that has loaded it; both must have the same bodies in every tick, and
/// in the end the same state.
void ExpectSameCourse(LoneRoom* room, std::int64_t ticks, const std::string& method = "buffer") {
  const Bytes bytes = room->Save();
  LoneRoom loaded(bytes, method);
  ASSERT_TRUE(loaded.server != nullptr) << loaded.status.why();
  loaded.now_us = room->now_us;
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
  EXPECT_NEAR(loaded.server->rules()->metadata().Get(health), hurt - 30 * 10 / 60.0, 1e-3);
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
    guest->SayJoin();
    for (int i = 0; i < 5; ++i) tick();
  };
  Guest bob(&room.network, 5001, "bob");
  join(&room, &bob);
  ASSERT_TRUE(bob.welcomed) << bob.refusal;
  bob.SendLoose(Encode(Ready()));
  Ready ready;
  bob.link.SendReliable(Encode(ready));
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
    replica.Persist(to);
    manager.Persist(to);
    const Bytes bytes = to.Take();
    Replica loaded(scene, config, 0, -1);
    AuthorityManager again(scene, config, loaded);
    StateArchive from(bytes);
    loaded.Persist(from);
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

/// A room with edits, rest, joints, a seat and a script: some of everything that is saved.
Bytes Rich() {
  LoneRoom room(Arena());
  room.StepTo(110);
  return room.Save();
}

TEST(RoomState, TruncatedBytesAreRefused) {
  const Bytes good = Rich();
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 40) {
    LoneRoom loaded(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)),
                    "buffer");
    ASSERT_TRUE(loaded.server == nullptr) << size;
    ASSERT_EQ(loaded.status.why().find("this is no saved room: "), 0u) << loaded.status.why();
  }
}

TEST(RoomState, FlippedBitsAreRefused) {
  const Bytes good = Rich();
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    Bytes bad = good;
    bad[random.Next() % bad.size()] ^= static_cast<std::uint8_t>(1u << random.Next() % 8);
    Status status;
    ASSERT_TRUE(SavedRoom::Read(bad, &status) == nullptr);
    ASSERT_FALSE(status.ok());
    ASSERT_EQ(status.why().find('\n'), std::string::npos);
  }
}

/// Makes the hash of changed bytes right again, as somebody would who means harm.
void Sign(Bytes* bytes) {
  const std::uint64_t hash = Fnv1a(bytes->data() + 24, bytes->size() - 24);
  std::memcpy(bytes->data() + 16, &hash, sizeof hash);
}

/// Bytes that are changed and signed may be accepted, if all that they say is possible; then the
/// room runs. Nothing crashes.
void Attack(const Bytes& good, int times, std::uint64_t seed) {
  Random random(seed);
  int refused = 0, accepted = 0;
  for (int i = 0; i < times; ++i) {
    Bytes bad = good;
    const int changes = 1 + static_cast<int>(random.Next() % 3);
    for (int c = 0; c < changes; ++c) {
      const std::size_t at = 24 + random.Next() % (bad.size() - 24);
      const std::uint64_t how = random.Next() % 4;
      if (how == 0) bad[at] = 0xff;
      if (how == 1) bad[at] = 0;
      if (how >= 2) bad[at] ^= static_cast<std::uint8_t>(1u << random.Next() % 8);
    }
    if (random.Chance(0.1)) bad.resize(24 + random.Next() % (bad.size() - 24));
    Sign(&bad);
    LoneRoom loaded(bad, "buffer");
    if (loaded.server == nullptr) {
      ++refused;
      ASSERT_FALSE(loaded.status.ok());
      ASSERT_EQ(loaded.status.why().find('\n'), std::string::npos) << loaded.status.why();
      continue;
    }
    ++accepted;
    for (int t = 0; t < 3; ++t) loaded.Step();
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(refused, times / 10);
  EXPECT_GT(accepted, 0);
}

TEST(RoomState, SignedDamageNeverCrashes) { Attack(Rich(), 2500, 1); }

TEST(RoomState, SignedDamageOfBondsSeatsAndWaterNeverCrashes) {
  for (const char* scene : {"dockside", "gluehouse", "ragdolls"}) {
    LoneRoom room(LoadScene("scenes/" + std::string(scene) + ".toml"));
    room.StepTo(100);
    Attack(room.Save(), 250, 2);
  }
}

TEST(RoomState, SavingIsQuick) {
  LoneRoom room(LoadScene("scenes/swarm.toml"));
  room.StepTo(30);
  const int bodies = room.server->replica().world().body_count();
  ASSERT_GE(bodies, 1000);
  double best_ms = 1e9;
  std::size_t bytes = 0;
  for (int i = 0; i < 5; ++i) {
    room.Step();
    const auto begin = Clock::now();
    bytes = room.Save().size();
    const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
    best_ms = std::min(best_ms, took.count());
  }
  std::printf("%d bodies: %.2f ms, %zu bytes\n", bodies, best_ms, bytes);
  EXPECT_LT(best_ms, 100) << "more than six ticks";
  EXPECT_LT(bytes, static_cast<std::size_t>(bodies) * 1000);
}

}  // namespace room_state_test
}  // namespace seam
