/// rollback: a push that is known elsewhere only when the pushed body has come to rest again.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/scripted_world.h"
#include "tests/support/wired_replicas.h"

namespace seam {
namespace late_push_test {

/// The server's crate, which ann's button pushes after it has come to rest.
std::string Pushed(const std::string& impulse) {
  return R"(
[[player]]
name = "ann"
actions = [{button = 0, part = "crate", impulse = )" +
         impulse + R"(}]
script = [[0, {}], [3, {buttons = [0]}], [3.1, {}]]
[[player]]
name = "bob"
[[part]]
name = "floor"
chain = [[-90, 0], [90, 0]]
friction = 0.3
[[part]]
name = "crate"
box = [1, 1]
position = [0.1, 0.6]
angle = 0.02
)";
}

constexpr std::int64_t kLate = 48, kPress = 180, kEnd = 420;

/// Peers whose messages, commitments to rest included, are all late by kLate ticks.
class LatePush {
 public:
  explicit LatePush(const std::string& impulse)
      : scene(ParseScene(Pushed(impulse), "pushed.toml")),
        room(scene, MakeSyncConfig("buffer", "rollback"), kLate,
             [](int peer, std::int64_t tick) {
               const bool down = peer == 1 && tick >= kPress && tick < kPress + 6;
               return Input{0, 0, static_cast<std::int16_t>(down ? 1 : 0)};
             }),
        crate(room.Body(0, "crate")) {}

  void StepTo(std::int64_t tick) {
    while (room.at(0).tick() < tick) Step();
  }

  const Scene scene;
  WiredReplicas room;
  const int crate;
  std::vector<std::pair<std::int64_t, Rest>> told;  // tick in which it was sent, and the message

 private:
  void Step() {
    room.Step();
    const std::int64_t now = room.at(0).tick();
    for (int peer = 0; peer < room.count(); ++peer) {
      for (const Rest& rest : room.at(peer).rest().Take()) told.emplace_back(now, rest);
    }
    for (const auto& [sent, rest] : told) {
      for (int peer = 0; sent + kLate == now && peer < room.count(); ++peer) {
        if (peer != rest.peer) room.at(peer).Receive(rest);
      }
    }
  }
};

/// The crate after kEnd ticks in one world that is built anew when the peers' worlds are.
BodyState Truth(const Scene& scene, int crate) {
  ScriptedWorld truth(scene);
  truth.world.Barrier();
  while (truth.world.tick() < kEnd) {
    truth.Step();
    if (truth.world.tick() % 2 == 0) truth.world.Barrier();
  }
  return truth.world.Read(crate);
}

/// A later tick would be an assumption, which a peer that knows a newer input takes for a fact.
TEST(LatePush, RestBeginsInATickOfWhichAllInputsAreKnown) {
  LatePush play("[1, 0]");
  play.StepTo(kEnd);
  EXPECT_GE(play.told.size(), 2u) << "before the push and after it";
  for (const auto& [sent, rest] : play.told) EXPECT_LE(rest.tick, sent - kLate);
}

TEST(LatePush, EveryPeerHasTheCrateWhereThePushLeftIt) {
  for (const char* impulse : {"[0.06, 0]", "[0.05, 0.01]", "[-0.07, 0]", "[0.4, 0]", "[1, 0]"}) {
    SCOPED_TRACE(impulse);
    LatePush play(impulse);
    play.StepTo(kPress - 1);
    ASSERT_TRUE(play.room.at(0).rest().Holds(play.crate)) << "it rests before the push";
    const Vec2 lay = play.room.at(0).world().Read(play.crate).position;
    play.StepTo(kEnd);
    const BodyState truth = Truth(play.scene, play.crate);
    ASSERT_NE(truth.position, lay) << "or nothing is tried";
    for (int peer = 0; peer < play.room.count(); ++peer) {
      const BodyState lies = play.room.at(peer).world().Read(play.crate);
      EXPECT_EQ(lies.position, truth.position) << "peer " << peer;
      EXPECT_EQ(lies.angle, truth.angle) << "peer " << peer;
      EXPECT_TRUE(play.room.at(peer).rest().Holds(play.crate)) << "peer " << peer;
    }
  }
}

}  // namespace late_push_test
}  // namespace seam
