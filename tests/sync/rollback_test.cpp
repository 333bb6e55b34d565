/// rollback: with the same inputs all peers agree, even if the inputs arrive late.

#include <gtest/gtest.h>

#include "common/base/geometry.h"
#include "common/sync/quantize.h"
#include "tests/support/quantised.h"
#include "tests/support/replica_test_access.h"
#include "tests/support/scripted_world.h"
#include "tests/support/wired_replicas.h"

namespace seam {
namespace rollback_test {

/// ann's and bob's sledges with a crate between, on a floor; the second button of each pushes the
/// crate. Nothing sleeps: being at rest has rules of its own.
const std::string kSledges = R"(
[solver]
sleep = false
[[player]]
name = "ann"
vehicle = "hers"
actions = [{button = 0, part = "hers", impulse = [20, 0]},
           {button = 1, part = "crate", impulse = [0, 3]}]
ANN
[[player]]
name = "bob"
vehicle = "his"
actions = [{button = 0, part = "his", impulse = [-20, 0]},
           {button = 1, part = "crate", impulse = [0, 3]}]
BOB
[[part]]
name = "floor"
chain = [[-90, 0], [90, 0]]
friction = 0.3
[[part]]
name = "hers"
box = [1, 1]
position = [-2.5, 0.5]
owner = "ann"
density = 2
[[part]]
name = "his"
box = [1, 1]
position = [2.5, 0.5]
owner = "bob"
density = 2
[[part]]
name = "crate"
box = [1, 1]
position = [0.1, 0.5]
restitution = 0.4
[[thrust]]
name = "jet-a"
part = "hers"
force = [30, 0]
player = "ann"
[[thrust]]
name = "jet-b"
part = "his"
force = [30, 0]
player = "bob"
)";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

/// Both push, let go, push again and press buttons: the crate is squeezed between them.
Scene Sledges() {
  const char* const ann =
      "script = [[0, {drive = 0.8}], [1.0, {drive = 0.3, buttons = [1]}], [1.5, {drive = 1}], "
      "[2.2, {drive = -1}], [2.6, {drive = 0.9, buttons = [0]}], [3.5, {}]]";
  const char* const bob =
      "script = [[0.2, {drive = -0.5}], [1.25, {drive = -0.4, buttons = [1]}], [1.9, {drive = "
      "0.6}], "
      "[2.4, {drive = -0.6, buttons = [0]}], [3.4, {}]]";
  return ParseScene(Replaced(Replaced(kSledges, "ANN", ann), "BOB", bob), "sledges.toml");
}

Input Scripted(const Scene& scene, int peer, std::int64_t tick) {
  Input input;
  for (const InputSpan& span : scene.players[static_cast<std::size_t>(peer - 1)].script) {
    if (span.from_tick <= tick) input = span.input;
  }
  return input;
}

WiredReplicas Scripted(const Scene& scene, std::int64_t late) {
  return WiredReplicas(
      scene, MakeSyncConfig("buffer", "rollback"), late,
      [scene](int peer, std::int64_t tick) { return Scripted(scene, peer, tick); });
}

constexpr std::int64_t kEnd = 300;

/// The truth: one world that is built anew at the ticks at which the peers build theirs.
std::vector<BodyState> Truth(const Scene& scene, std::int64_t end) {
  ScriptedWorld truth(scene);
  truth.world.Barrier();
  while (truth.world.tick() < end) {
    truth.Step();
    if (truth.world.tick() % 2 == 0) truth.world.Barrier();
  }
  std::vector<BodyState> states;
  for (int body = 0; body < truth.world.body_count(); ++body) {
    states.push_back(truth.world.Read(body));
  }
  return states;
}

void ExpectBits(const World& world, const std::vector<BodyState>& states, const std::string& who) {
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState is = world.Read(body), should = states[static_cast<std::size_t>(body)];
    EXPECT_EQ(is.position, should.position) << who << ", body " << body;
    EXPECT_EQ(is.angle, should.angle) << who << ", body " << body;
    EXPECT_EQ(is.velocity, should.velocity) << who << ", body " << body;
    EXPECT_EQ(is.spin, should.spin) << who << ", body " << body;
  }
}

TEST(Rollback, LateInputsLeaveAllPeersWithTheTruthBitForBit) {
  const Scene scene = Sledges();
  const std::vector<BodyState> truth = Truth(scene, kEnd);
  EXPECT_GT((truth[2].position - Vec2(0.1f, 0.5f)).norm(), 0.5f) << "the crate was moved";
  for (const std::int64_t late : {0, 1, 6, 12}) {
    WiredReplicas room = Scripted(scene, late);
    room.StepTo(kEnd);
    for (int peer = 0; peer < room.count(); ++peer) {
      ExpectBits(room.at(peer).world(), truth,
                 "peer " + std::to_string(peer) + ", late by " + std::to_string(late));
    }
  }
}

TEST(Rollback, EqualsTheTruthAtEveryTickOnAPerfectNetwork) {
  const Scene scene = Sledges();
  WiredReplicas room = Scripted(scene, 0);
  ScriptedWorld truth(scene);
  truth.world.Barrier();
  while (truth.world.tick() < kEnd) {
    truth.Step();
    if (truth.world.tick() % 2 == 0) truth.world.Barrier();
    room.Step();
    for (int peer = 0; peer < room.count(); ++peer) {
      ASSERT_EQ(room.at(peer).world().Hash(), truth.world.Hash())
          << "peer " << peer << ", tick " << truth.world.tick();
    }
  }
}

/// Only ann acts: with `input` from `from` to before `until`.
WiredReplicas OnlyAnn(const Scene& scene, std::int64_t late, std::int64_t from, std::int64_t until,
                      Input input) {
  return WiredReplicas(scene, MakeSyncConfig("buffer", "rollback"), late,
                       [=](int peer, std::int64_t tick) {
                         return peer == 1 && tick >= from && tick < until ? input : Input{};
                       });
}

/// kSledges without gravity and scripts: nothing moves that is not pushed.
Scene Floating() {
  return ParseScene("gravity = [0, 0]\n" + Replaced(Replaced(kSledges, "ANN", ""), "BOB", ""),
                    "floating.toml");
}

TEST(Rollback, ALatePressActsOnceAtItsTickOnEveryPeer) {
  constexpr std::int64_t kPress = 51;
  WiredReplicas room = OnlyAnn(Floating(), 9, kPress, kPress + 5, Input{0, 0, 2});
  const float speed = 3;  // N s, on 1 kg
  room.StepTo(kPress - 1);
  const float before = room.Read(0, "crate").position.y();
  room.StepTo(kPress);
  EXPECT_NEAR(room.Read(1, "crate").velocity.y(), speed, 1e-5f) << "who presses sees it at once";
  EXPECT_EQ(room.Read(0, "crate").velocity.y(), 0) << "nobody else knows yet";
  room.StepTo(kPress + 30);
  for (int peer = 0; peer < room.count(); ++peer) {
    const BodyState crate = room.Read(peer, "crate");
    EXPECT_NEAR(crate.velocity.y(), speed, 1e-5f) << "once at peer " << peer;
    EXPECT_NEAR(crate.position.y() - before, speed * 31 / 60, 1e-4f) << "since " << kPress;
  }
}

TEST(Rollback, APressTooOldToReplayActsOnceAtTheAuthorityAndOthersFollow) {
  constexpr std::int64_t kPress = 51, kHeard = 220;
  WiredReplicas room = OnlyAnn(Floating(), 3, kPress, kPress + 5, Input{0, 0, 2});
  // ann's lines are down for longer than there is a way back.
  room.held_up = [&](int from, int to) {
    return (from == 1 || to == 1) && room.at(0).tick() < kHeard;
  };
  room.StepTo(kHeard);
  EXPECT_EQ(room.Read(0, "crate").velocity.y(), 0);
  EXPECT_EQ(room.Read(2, "crate").velocity.y(), 0);
  room.StepTo(kHeard + 40);
  EXPECT_NEAR(room.Read(0, "crate").velocity.y(), 3, 1e-5f) << "once";
  const float y = room.Read(0, "crate").position.y() - 0.5f;
  EXPECT_GT(y, 3.0f * 30 / 60);
  EXPECT_LT(y, 3.0f * 45 / 60) << "not since it was pressed";
  for (const int peer : {1, 2}) {
    EXPECT_NEAR(room.Read(peer, "crate").position.y() - 0.5f, y, 0.01f) << "peer " << peer;
    EXPECT_NEAR(room.Read(peer, "crate").velocity.y(), 3, 0.02f) << "peer " << peer;
  }
}

TEST(Rollback, SendsTheStateBeforeUnknownInputsThatMayReachIt) {
  const Scene scene = Sledges();
  constexpr std::int64_t kLate = 10;
  WiredReplicas room = Scripted(scene, kLate);
  room.StepTo(120);  // all three are near each other
  int told = 0;
  room.each_states = [&](int peer, const States& states) {
    if (peer != 1) return;
    ++told;
    EXPECT_GE(room.at(1).tick() - states.tick, kLate) << "of bob nothing is known sooner";
    const std::vector<BodyState> truth = Truth(scene, states.tick);
    for (std::size_t i = 0; i < states.id.size(); ++i) {
      const int body = room.at(1).world().BodyOfId(states.id[i]);
      const BodyState should = Quantised(truth[static_cast<std::size_t>(body)]);
      const BodyState is = Unpack(states, i, should.angle);
      EXPECT_EQ(is.position, should.position) << "tick " << states.tick;
      EXPECT_EQ(is.velocity, should.velocity) << "tick " << states.tick;
    }
  };
  room.StepTo(300);
  EXPECT_NEAR(told, 3 * kRefreshHz, 1) << "of what all simulate";
}

TEST(Rollback, SendsTheCurrentStateFarFromOtherPlayers) {
  const Scene scene = ParseScene(
      "[[player]]\nname = \"ann\"\nvehicle = \"hers\"\n[[player]]\nname = \"bob\"\n"
      "vehicle = \"his\"\n"
      "[[part]]\nname = \"hers\"\nbox = [1, 1]\nposition = [0, 500]\nowner = \"ann\"\n"
      "[[part]]\nname = \"his\"\nbox = [1, 1]\nposition = [400, 500]\nowner = \"bob\"\n",
      "far.toml");
  WiredReplicas room = Scripted(scene, 10);
  room.each_states = [&](int peer, const States& states) {
    EXPECT_EQ(states.tick, room.at(peer).tick());
  };
  room.StepTo(60);
}

TEST(Rollback, ANewlyFollowedBodyReplaysFromItsLastState) {
  const Scene scene = ParseScene(
      "[[player]]\nname = \"ann\"\n"
      "[[part]]\nname = \"floor\"\nchain = [[-90, 0], [90, 0]]\n"
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 6.5]\nrestitution = 0.8\n"
      "[[part]]\nname = \"slab\"\nbox = [8, 1]\nposition = [0, 0.5]\ndensity = 50\n",
      "ball.toml");
  constexpr std::int64_t kBounce = 60, kLate = 8;  // 5 m of fall last 60 ticks
  WiredReplicas room = Scripted(scene, kLate);
  room.Give(1, 0, 0, false);
  room.StepTo(kBounce + 3);
  EXPECT_GT(room.Read(0, "ball").velocity.y(), 5) << "it has bounced";
  EXPECT_LT(room.Read(1, "ball").velocity.y(), -5) << "what is shown meets no slab";
  room.Give(1, 0, 0, true);
  room.Step();
  const BodyState is = room.Read(1, "ball"), should = room.Read(0, "ball");
  // The state that was heard was rounded.
  EXPECT_NEAR((is.velocity - should.velocity).norm(), 0, 0.1f);
  EXPECT_NEAR((is.position - should.position).norm(), 0, 0.05f);
}

/// The crate comes to rest at the server; bob's copy of it is off by `off` since tick 5, and the
/// announcement of rest reaches him after `word_late` ticks. From then on it must rest at the
/// server's pose, although he replays in every tick.
void ExpectBobsCopyRests(const BodyState& off, std::int64_t word_late) {
  const Scene scene =
      ParseScene(Replaced(Replaced(Replaced(kSledges, "sleep = false", ""), "ANN", ""), "BOB", ""),
                 "sledges.toml");
  constexpr std::int64_t kLate = 10;
  constexpr int kBob = 2;
  // A button that does nothing goes down and up: there is something to go back for in every tick.
  WiredReplicas room(scene, MakeSyncConfig("buffer", "rollback"), kLate,
                     [](int peer, std::int64_t tick) {
                       const bool down = peer == 1 && tick > 30 && tick % 2 == 0;
                       return Input{0, 0, static_cast<std::int16_t>(down ? 4 : 0)};
                     });
  room.StepTo(5);
  room.states_flow = off.position.norm() == 0;  // or the server's states would take it back
  const int crate = room.Body(kBob, "crate");
  BodyState moved = room.at(kBob).world().Read(crate);
  moved.position += off.position;
  moved.angle += off.angle;
  ReplicaTestAccess::world(room.at(kBob)).Write(crate, moved);
  std::vector<std::pair<std::int64_t, Rest>> words;
  bool told = false;
  int held = 0;
  while (room.at(0).tick() < 240) {
    room.Step();
    const std::int64_t now = room.at(0).tick();
    for (const Rest& rest : room.at(0).rest().Take()) words.emplace_back(now + word_late, rest);
    for (const auto& [due, rest] : words) {
      if (due != now) continue;
      room.at(kBob).Receive(rest);
      told = true;
    }
    if (!told) continue;
    ++held;
    const BodyState is = room.at(kBob).world().Read(crate), should = room.at(0).world().Read(crate);
    ASSERT_TRUE(room.at(kBob).rest().Holds(crate)) << "tick " << now;
    ASSERT_EQ(is.angle, should.angle) << "tick " << now;
    ASSERT_EQ(is.position, should.position) << "tick " << now;
  }
  EXPECT_GT(held, 60);
  EXPECT_GT(room.at(kBob).ticks_stepped_again(), 60) << "or nothing was tried";
}

TEST(Rollback, ARestingBodyStaysAtRestInAReplayWithATurnedCopy) {
  BodyState off;
  off.angle = 12 * kPiFloat;
  ExpectBobsCopyRests(off, 0);
}

TEST(Rollback, ARestingBodyStaysAtRestInALaterReplayWithADisplacedCopy) {
  BodyState off;
  off.position.x() = 0.05f;
  ExpectBobsCopyRests(off, 20);
}

}  // namespace rollback_test
}  // namespace seam
