/// Mode central: the bodies that a client simulates ahead of the server.

#include <gtest/gtest.h>

#include "common/sync/method.h"
#include "tests/support/wired_replicas.h"

namespace seam {
namespace predict_test {

const char* const kRoom = R"(
gravity = [0, 0]
[solver]
sleep = false
[[player]]
name = "ann"
vehicle = "hers"
actions = [{button = 0, part = "hers", impulse = [3, 0]},
           {button = 1, part = "crate", impulse = [0, 3]}]
[[player]]
name = "bob"
vehicle = "his"
[[part]]
name = "hers"
box = [1, 1]
position = [-30, 0.5]
owner = "ann"
[[part]]
name = "his"
box = [1, 1]
position = [9, 0.5]
owner = "bob"
velocity = [1, 0]
[[part]]
name = "crate"
box = [1, 1]
position = [0, 0.5]
[[thrust]]
name = "jet"
part = "his"
force = [6, 0]
player = "bob"
)";

constexpr std::int64_t kPress = 31, kLate = 8;

/// ann presses `buttons` for a while, bob drives from the same tick on.
WiredReplicas Central(const std::string& predict, std::int16_t buttons) {
  const SyncConfig config = MakeSyncConfig(MethodNames{"central", "", predict});
  return WiredReplicas(ParseScene(kRoom, "room.toml"), config, kLate,
                       [buttons](int peer, std::int64_t tick) {
                         if (tick < kPress) return Input{};
                         if (peer == 2) return Input{127, 0, 0};
                         return tick < kPress + 10 ? Input{0, 0, buttons} : Input{};
                       });
}

TEST(Predict, OwnPredictsTheDrivenBodiesAndAllPredictsEverything) {
  WiredReplicas own = Central("own", 0), all = Central("all", 0);
  for (const char* part : {"hers", "his", "crate"}) {
    const bool is_own = std::string(part) == "hers";
    EXPECT_EQ(own.at(1).world().activity(own.Body(1, part)) == Activity::kSimulated, is_own)
        << part;
    EXPECT_EQ(all.at(1).world().activity(all.Body(1, part)), Activity::kSimulated) << part;
    EXPECT_EQ(own.at(0).world().activity(own.Body(0, part)), Activity::kSimulated) << part;
  }
}

TEST(Predict, OwnButtonsActAtOnceOnPredictedBodies) {
  for (const char* const predict : {"own", "all"}) {
    WiredReplicas room = Central(predict, 1);
    room.StepTo(kPress);
    EXPECT_NEAR(room.Read(1, "hers").velocity.x(), 3, 1e-5f);
    EXPECT_EQ(room.Read(0, "hers").velocity.x(), 0) << "the server has not heard of it";
    room.StepTo(kPress + 60);
    EXPECT_NEAR(room.Read(0, "hers").velocity.x(), 3, 1e-5f) << "once";
    EXPECT_NEAR(room.Read(1, "hers").velocity.x(), 3, 0.02f) << "once";
  }
}

TEST(Predict, OwnButtonsActAtOnceOnOtherBodiesOnlyIfAllArePredicted) {
  WiredReplicas all = Central("all", 2), own = Central("own", 2);
  all.StepTo(kPress);
  own.StepTo(kPress);
  EXPECT_NEAR(all.Read(1, "crate").velocity.y(), 3, 1e-5f);
  EXPECT_EQ(own.Read(1, "crate").velocity.y(), 0);
  all.StepTo(kPress + 90);
  own.StepTo(kPress + 90);
  for (const int peer : {0, 1, 2}) {
    EXPECT_NEAR(all.Read(peer, "crate").velocity.y(), 3, 0.02f) << peer;
    EXPECT_NEAR(own.Read(peer, "crate").velocity.y(), 3, 0.2f) << peer;
  }
}

TEST(Predict, AllStepsOthersWithTheirKnownInputs) {
  WiredReplicas all = Central("all", 0);
  all.StepTo(kPress + 3 * kLate);
  // The server acts on received inputs, kLate ticks late; both clients extrapolate its state by
  // their known inputs: so all three have bob's thrust of 6 m/s^2 for as many ticks.
  const float speed = 1 + 6.0f * (2 * kLate + 1) / 60;
  for (const int peer : {0, 1, 2}) {
    EXPECT_NEAR(all.Read(peer, "his").velocity.x(), speed, 0.02f) << "peer " << peer;
  }
}

}  // namespace predict_test
}  // namespace seam
