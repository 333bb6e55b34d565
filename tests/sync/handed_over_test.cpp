/// rollback: a state sent at a hand-over cannot be changed by a later input.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/sync/edits/edit_order.h"
#include "common/sync/inputs/input_source.h"
#include "tests/support/scripted_world.h"
#include "tests/support/wired_replicas.h"

namespace seam {
namespace handed_over_test {

/// ann and bob squeeze the server's crate, now more, now less. Nothing sleeps.
Scene Squeezed() {
  return ParseScene(R"(
[solver]
sleep = false
[[player]]
name = "ann"
vehicle = "hers"
script = [[0, {drive = 0.8}], [1.0, {drive = 0.3}], [1.5, {drive = 1}], [2.2, {}]]
[[player]]
name = "bob"
vehicle = "his"
script = [[0, {drive = -0.8}], [1.2, {drive = -0.3}], [1.6, {drive = -0.9}], [2.3, {}]]
[[part]]
name = "floor"
chain = [[-90, 0], [90, 0]]
friction = 0.3
[[part]]
name = "hers"
box = [1, 1]
position = [-1.5, 0.5]
owner = "ann"
[[part]]
name = "his"
box = [1, 1]
position = [1.5, 0.5]
owner = "bob"
[[part]]
name = "crate"
box = [1, 1]
position = [0.1, 0.5]
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
)",
                    "squeezed.toml");
}

constexpr std::int64_t kEnd = 240, kLate = 10;

WiredReplicas Room(const Scene& scene) {
  return WiredReplicas(
      scene, MakeSyncConfig("buffer", "rollback"), kLate,
      [scene](int peer, std::int64_t tick) { return ScriptedInput(scene, peer - 1, tick); });
}

/// One world that is built anew at the ticks at which the peers build theirs; by tick and body.
std::vector<std::vector<BodyState>> Truth(const Scene& scene) {
  ScriptedWorld truth(scene);
  truth.world.Barrier();
  std::vector<std::vector<BodyState>> states;
  while (true) {
    states.emplace_back();
    for (int body = 0; body < truth.world.body_count(); ++body) {
      states.back().push_back(truth.world.Read(body));
    }
    if (truth.world.tick() == kEnd) return states;
    truth.Step();
    if (truth.world.tick() % 2 == 0) truth.world.Barrier();
  }
}

/// The server grants the crate at a tick, when all inputs up to `known` have arrived; every peer
/// ends with the pose that the inputs cause.
void GiveCrate(std::int64_t given, std::int64_t known,
               const std::vector<std::vector<BodyState>>& truth, WiredReplicas* room) {
  room->StepTo(given);
  const World& world = room->at(0).world();
  const int crate = room->Body(0, "crate");
  const auto body = static_cast<std::size_t>(crate);
  const std::vector<ExactStates> told = room->at(0).MakeExact({world.mechanism(crate)}, 1);
  ASSERT_EQ(told.size(), 1u);
  const ExactStates& exact = told[0];
  EXPECT_LE(exact.tick, known);
  EXPECT_GE(exact.tick, known - 2) << "no older than it has to be";
  const BodyState& then = truth[static_cast<std::size_t>(exact.tick)][body];
  EXPECT_EQ(Vec2(exact.x[0], exact.y[0]), then.position);
  EXPECT_EQ(Vec2(exact.vx[0], exact.vy[0]), then.velocity);
  EXPECT_NE(world.Read(crate).position, truth[static_cast<std::size_t>(given)][body].position)
      << "what it has itself is wrong";
  room->StepTo(given + kLate);
  for (const int peer : {1, 2}) room->at(peer).TakeOver(exact);
  room->StepTo(kEnd);
  for (int peer = 0; peer < room->count(); ++peer) {
    const BodyState is = room->Read(peer, "crate"), should = truth[kEnd][body];
    EXPECT_EQ(is.position, should.position) << "peer " << peer;
    EXPECT_EQ(is.velocity, should.velocity) << "peer " << peer;
  }
}

/// Others would apply a state that depends on assumed inputs unchanged, and never reach the pose
/// that the inputs cause.
TEST(HandOverState, SendsTheStateBeforeUnknownInputsThatMayReachIt) {
  const Scene scene = Squeezed();
  const std::vector<std::vector<BodyState>> truth = Truth(scene);
  for (const std::int64_t given : {63, 94, 136}) {  // inputs have just changed
    SCOPED_TRACE(given);
    WiredReplicas room = Room(scene);
    GiveCrate(given, given - kLate, truth, &room);
  }
}

/// Nothing is assumed about a silent player for up to kDriverSilentUs: a mechanism handed over then
/// is sent as of the player's last input.
TEST(HandOverState, SendsTheStateFromTheLastInputOfASilentPlayer) {
  const Scene scene = Squeezed();
  constexpr std::int64_t kCut = 60, kGiven = 107, kHeard = 115;
  WiredReplicas room = Room(scene);
  room.held_up = [&room](int from, int to) {
    const std::int64_t now = room.at(0).tick();
    return (from == 2 || to == 2) && now >= kCut && now < kHeard;
  };
  GiveCrate(kGiven, kCut - kLate, Truth(scene), &room);
}

/// Right after an edit nobody has looked yet how far inputs reach.
TEST(HandOverState, SendsANewPartNoEarlierThanItsEdit) {
  WiredReplicas room = Room(Squeezed());
  room.StepTo(120);
  InsertEdit insert;
  insert.text = "[[part]]\nname = \"ball\"\ncircle = 0.2\nposition = [0, 9]\n";
  EditOrder order = ToOrder(Edit(insert));
  order.tick = 117;
  order.number = room.at(0).revision();
  ASSERT_TRUE(room.at(0).Queue(order));
  room.at(0).ApplyEdits();
  const int ball = room.Body(0, "ball");
  ASSERT_GE(ball, 0);
  const std::vector<ExactStates> told =
      room.at(0).MakeExact({room.at(0).world().mechanism(ball)}, 1);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_GE(told[0].tick, 117);
  EXPECT_LE(told[0].y[0], 9.0f);
  EXPECT_GT(told[0].y[0], 8.9f);
}

/// While a client loads the room it may be given something and asked for it again: all of that can
/// come in one datagram, before its first step. And the server plans in its first ticks, of which
/// it looks at every second.
TEST(HandOverState, SendsTheCurrentStateIfRevokedBeforeTheFirstStep) {
  Replica ann(Squeezed(), MakeSyncConfig("buffer", "rollback"), 1, 0);
  const int hers = ann.world().mechanism(0);
  const auto grant = [&](int peer, int epoch) {
    Grants grants;
    grants.mechanism = {ann.authority().id(hers)};
    grants.authority = {static_cast<std::int16_t>(peer)};
    grants.epoch = {epoch};
    grants.followers = {0};
    return ann.ApplyGrants(grants);
  };
  EXPECT_TRUE(grant(1, 1).empty());
  EXPECT_EQ(grant(0, 2), std::vector<int>{hers});
  const std::vector<ExactStates> told = ann.TakeReleased();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].tick, ann.tick());
  EXPECT_EQ(told[0].id.size(), 1u);
  EXPECT_EQ(told[0].x[0], -1.5f);
  EXPECT_EQ(told[0].y[0], 0.5f);
}

TEST(HandOverState, SendsTheCurrentStateInTheServersFirstTick) {
  Replica server(Squeezed(), MakeSyncConfig("buffer", "rollback"), 0, -1);
  server.Step();
  const std::vector<ExactStates> told = server.MakeExact({server.world().mechanism(0)}, 1);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].tick, server.tick());
  EXPECT_EQ(told[0].x[0], server.world().Read(0).position.x());
}

}  // namespace handed_over_test
}  // namespace seam
