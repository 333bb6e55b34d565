/// Bodies that are displayed only follow their path, touch nothing, and return unchanged with their
/// joints.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/base/random.h"
#include "common/physics/world.h"
#include "tests/support/scripted_world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace displayed_body_test {

const char* const kNoGravity = "gravity = [0, 0]\n";
constexpr int kBall = 0, kShown = 1;

std::unique_ptr<World> TwoDiscs() {
  return SmallWorld(
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 0]\n"
      "[[part]]\nname = \"shown\"\ncircle = 0.5\nposition = [3, 0]\n",
      "", kNoGravity);
}

TEST(DisplayedBody, OthersPassThroughItAndItFollowsItsPath) {
  const std::unique_ptr<World> world = TwoDiscs();
  world->SetActivity(kShown, Activity::kDisplayed);
  const BodyState start{{3, 0}, 0.25f, {-1, 0.125f}, 2};
  world->Write(kShown, start);
  BodyState ball = world->Read(kBall);
  ball.velocity = {6, 0};
  world->Write(kBall, ball);
  for (int tick = 1; tick <= 60; ++tick) {
    world->Step();
    const auto t = static_cast<float>(tick) * world->dt();
    const BodyState now = world->Read(kShown);
    EXPECT_NEAR((now.position - start.position - t * start.velocity).norm(), 0, 1e-5) << tick;
    EXPECT_NEAR(now.angle, start.angle + t * start.spin, 1e-5) << tick;
    EXPECT_EQ(now.velocity, start.velocity) << tick;
    EXPECT_TRUE(world->touches().empty()) << tick;
  }
  EXPECT_NEAR(world->Read(kBall).position.x(), 6, 1e-4);
}

TEST(DisplayedBody, CollidesAgainAfterItsReturn) {
  const std::unique_ptr<World> world = TwoDiscs();
  world->SetActivity(kShown, Activity::kDisplayed);
  Steps(world.get(), 5);
  world->SetActivity(kShown, Activity::kSimulated);
  BodyState ball = world->Read(kBall);
  ball.velocity = {6, 0};
  world->Write(kBall, ball);
  Steps(world.get(), 60);
  EXPECT_GT(world->Read(kShown).velocity.x(), 2);
  EXPECT_LT(world->Read(kBall).velocity.x(), 4);
}

TEST(DisplayedBody, SleepsWhenItsPathStandsStill) {
  const std::unique_ptr<World> world = TwoDiscs();
  world->SetActivity(kShown, Activity::kDisplayed);
  world->Step();
  EXPECT_FALSE(world->awake(kShown));
  BodyState shown = world->Read(kShown);
  shown.velocity = {1, 0};
  world->Write(kShown, shown);
  EXPECT_TRUE(world->awake(kShown));
}

/// Of the bodies that are not present only a dormant one was asleep for its own reasons.
TEST(DisplayedBody, IsAwakeWhenItIsSimulatedUnlessItWasDormant) {
  for (const Activity before : {Activity::kDisplayed, Activity::kParked, Activity::kDormant}) {
    World world(
        ParseScene("gravity = [0, 0]\n[[part]]\nname = \"disc\"\ncircle = 0.5\n", "test.toml"));
    world.SetAwake(0, false);
    world.SetActivity(0, before);
    Steps(&world, 5);
    EXPECT_TRUE(world.present().empty());
    EXPECT_FALSE(world.awake(0));
    world.SetActivity(0, Activity::kSimulated);
    EXPECT_EQ(world.present().size(), 1u);
    EXPECT_EQ(world.awake(0), before != Activity::kDormant) << static_cast<int>(before);
  }
}

TEST(DisplayedBody, IsTheSameForBox2DWhenItIsParked) {
  const std::unique_ptr<World> world = TwoDiscs();
  world->SetActivity(kShown, Activity::kDisplayed);
  Steps(world.get(), 2);
  const std::uint64_t still = world->still(kShown);
  ASSERT_NE(still, 0u);
  world->SetActivity(kShown, Activity::kParked);
  EXPECT_EQ(world->activity(kShown), Activity::kParked);
  EXPECT_EQ(world->still(kShown), still);
}

TEST(DisplayedBody, KeepsTheMotionOfItsOriginIfItsMassLiesElsewhere) {
  // Three quarters of the mass left of the root's middle: it turns about the common centre.
  const std::unique_ptr<World> world = SmallWorld(
      "[[part]]\nname = \"heavy\"\nbox = [1, 1]\ndensity = 3\nposition = [10, 5]\n"
      "[[part]]\nname = \"light\"\nbox = [1, 1]\nposition = [12, 5]\n"
      "[[joint]]\nname = \"bar\"\nkind = \"weld\"\na = \"light\"\nb = \"heavy\"\n",
      "", kNoGravity);
  BodyState state = world->Read(0);
  state.velocity = {1, 0};
  state.spin = 2;
  world->Write(0, state);
  world->SetActivity(0, Activity::kDisplayed);
  world->SetActivity(0, Activity::kSimulated);
  const BodyState back = world->Read(0);
  EXPECT_NEAR((back.velocity - state.velocity).norm(), 0, 1e-5);
  EXPECT_EQ(back.spin, state.spin);
}

TEST(DisplayedBody, KeepsItsPoseAmongManyAbsentBodies) {
  constexpr int kMany = 100;  // several of a snapshot's pages
  const std::unique_ptr<World> world = SmallWorld(
      "[[part]]\nname = \"disc\"\ncircle = 0.5\nposition = [0, 0]\n"
      "repeat = {count = 100, step = [3, 0]}\n",
      "", kNoGravity);
  std::vector<BodyState> placed;
  for (int body = 0; body < kMany; ++body) {
    const auto at = static_cast<float>(body);
    placed.push_back({{3 * at, 7 + at}, 0.01f * at, {0, 0}, 0});
    world->Write(body, placed.back());
  }
  for (int body = 1; body < kMany; ++body) world->SetActivity(body, Activity::kDisplayed);
  world->Step();
  const WorldSnapshot then = world->Barrier();
  for (int body = 1; body < kMany; ++body) {
    const BodyState now = world->Read(body);
    EXPECT_EQ(now.position, placed[static_cast<std::size_t>(body)].position) << body;
    EXPECT_EQ(now.angle, placed[static_cast<std::size_t>(body)].angle) << body;
    EXPECT_EQ(then.bodies[static_cast<std::size_t>(body)].state.position, now.position) << body;
  }
  BodyState moved = world->Read(70);
  moved.position.y() += 5;
  world->Write(70, moved, false);
  ASSERT_TRUE(world->Restore(then).ok());
  EXPECT_EQ(world->Read(70).position, placed[70].position) << "it goes back as well";
}

TEST(DisplayedBody, EachBarrierHoldsEveryBodyThroughAbsenceAndWrites) {
  constexpr int kMany = 100;
  const std::unique_ptr<World> world = SmallWorld(
      "[[part]]\nname = \"disc\"\ncircle = 0.5\nposition = [0, 0]\nvelocity = [0.5, 0]\n"
      "repeat = {count = 100, step = [1.2, 0]}\n",
      "", kNoGravity);
  Random random(5);
  const auto any = [&] { return static_cast<int>(random.Next() % kMany); };
  std::vector<WorldSnapshot> barriers;
  for (int tick = 0; tick < 300; ++tick) {
    for (int i = 0; i < 3; ++i) {
      world->SetActivity(any(),
                         random.Next() % 4 == 0 ? Activity::kSimulated : Activity::kDisplayed);
    }
    const int moved = any();
    BodyState state = world->Read(moved);
    state.position.y() += 0.25f;
    state.velocity.x() = random.Next() % 2 == 0 ? 0.0f : 1.0f;
    world->Write(moved, state, random.Next() % 2 == 0);
    world->SetAwake(any(), random.Next() % 2 == 0);
    world->Step();
    if (tick % 3 != 0) continue;
    if (tick % 30 == 0 && !barriers.empty()) {
      ASSERT_TRUE(world->Restore(barriers[random.Next() % barriers.size()]).ok());
    }
    barriers.push_back(world->Barrier());
    for (int body = 0; body < kMany; ++body) {
      const WorldSnapshot::Body& told = barriers.back().bodies[static_cast<std::size_t>(body)];
      const BodyState now = world->Read(body);
      EXPECT_EQ(told.state.position, now.position) << tick << " " << body;
      EXPECT_EQ(told.state.velocity, now.velocity) << tick << " " << body;
      EXPECT_EQ(told.awake, world->awake(body)) << tick << " " << body;
    }
  }
}

/// A rope of links from a post, and a box that lies apart.
const char* const kRope = R"(
[[part]]
name = "post"
circle = 0.2
anchored = true
[[part]]
name = "link"
box = [1, 0.2]
position = [0.5, 0]
repeat = {count = 4, step = [1, 0]}
[[part]]
name = "apart"
box = [1, 1]
position = [30, 0]
[[joint]]
name = "first"
kind = "hinge"
a = "post"
b = "link.0"
anchor = [0, 0]
[[joint]]
name = "pin"
kind = "hinge"
a = "link.0"
b = "link.1"
anchor = [1, 0]
repeat = {count = 3, step = [1, 0]}
)";

constexpr int kLinks = 4;

void SetRope(World* world, Activity activity) {
  for (int body = 0; body < kLinks; ++body) world->SetActivity(body, activity);
}

/// Largest distance between the two points of a pin, m.
double Open(const World& world) {
  double worst = 0;
  for (const Pin& pin : world.Pins()) {
    const auto at = [&](const PinEnd& end) -> Vec2 {
      const BodyState s = world.ReadAssembly(end.assembly);
      return s.position + Turned(end.point, s.angle);
    };
    worst = std::max(worst, static_cast<double>((at(pin.a) - at(pin.b)).norm()));
  }
  return worst;
}

class NotPresent : public testing::TestWithParam<Activity> {};

TEST_P(NotPresent, JointsAreKnownAndHoldAfterTheReturn) {
  for (const char* joints : {"joints = \"exact\"\n", "joints = \"iterative\"\n"}) {
    const std::unique_ptr<World> world = SmallWorld(kRope, joints);
    Steps(world.get(), 30);
    const std::size_t pins = world->Pins().size();
    ASSERT_EQ(pins, 4u);
    SetRope(world.get(), GetParam());
    Steps(world.get(), 1);
    EXPECT_EQ(world->Pins().size(), pins) << joints;
    PushEdit push;  // changes no bodies, but the next barrier builds all of them anew
    push.part = world->id(kLinks);
    EXPECT_FALSE(world->Apply({Edit(push)}).has_value());
    world->Barrier();
    EXPECT_EQ(world->Pins().size(), pins) << joints;
    SetRope(world.get(), Activity::kSimulated);
    Steps(world.get(), 120);
    EXPECT_EQ(world->Pins().size(), pins);
    EXPECT_LT(Open(*world), 0.03) << joints;
    EXPECT_LT(world->Read(kLinks).position.y(), -20) << "what lies apart fell on";
  }
}

INSTANTIATE_TEST_SUITE_P(Activities, NotPresent,
                         testing::Values(Activity::kDisplayed, Activity::kParked,
                                         Activity::kDormant));

TEST(DisplayedBody, AWorldGoesBackToATickWithOtherPresentBodies) {
  const std::unique_ptr<World> world = SmallWorld(kRope);
  Steps(world.get(), 30);
  const WorldSnapshot then = world->Barrier();
  Steps(world.get(), 20);
  const std::uint64_t hash = world->Hash();
  SetRope(world.get(), Activity::kDisplayed);
  Steps(world.get(), 10);
  ASSERT_TRUE(world->Restore(then).ok()) << "not present now";
  EXPECT_EQ(world->Read(2).position, then.bodies[2].state.position);
  SetRope(world.get(), Activity::kSimulated);
  ASSERT_TRUE(world->Restore(then).ok());
  Steps(world.get(), 20);
  EXPECT_EQ(world->Hash(), hash) << "bit for bit as without the absence";
}

TEST(DisplayedBody, AnEditReachesAnAbsentBody) {
  const std::unique_ptr<World> world = SmallWorld(kRope);
  SetRope(world.get(), Activity::kDisplayed);
  Steps(world.get(), 2);
  constexpr int kSecondPin = 2;
  EXPECT_TRUE(world->Apply({Edit(BreakEdit{kSecondPin})}).has_value()) << "joints are others now";
  EXPECT_EQ(world->Pins().size(), 3u);
  Steps(world.get(), 2);
  EXPECT_EQ(world->activity(0), Activity::kDisplayed) << "still";
  EXPECT_EQ(world->Pins().size(), 3u);
  SetRope(world.get(), Activity::kSimulated);
  Steps(world.get(), 120);
  EXPECT_GT(world->Read(1).position.y(), -3) << "it hangs";
  EXPECT_LT(world->Read(2).position.y(), -10) << "it has come off";
}

class AbsentInScene : public testing::TestWithParam<const char*> {};

TEST_P(AbsentInScene, RemovingAndReturningEverySecondMechanismKeepsTheRest) {
  ScriptedWorld run(GetParam());
  World& world = run.world;
  run.StepTo(30);
  const auto let = [&](Activity activity) {
    for (int body = 0; body < world.body_count(); ++body) {
      if (world.mechanism(body) % 2 == 0) world.SetActivity(body, activity);
    }
  };
  let(Activity::kDisplayed);
  run.StepTo(50);
  const WorldSnapshot then = world.Barrier();
  run.StepTo(60);
  let(Activity::kSimulated);
  run.StepTo(120);
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState s = world.Read(body);
    ASSERT_TRUE(s.position.allFinite() && s.velocity.allFinite()) << body;
    EXPECT_LT(s.velocity.norm(), world.scene().speed_limit) << body;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AbsentInScene,
                         testing::Values("obstacle", "ragdolls", "regatta", "gluehouse", "conveyor",
                                         "playground", "tracks", "freight", "skyline",
                                         "battlefield", "harbour", "titanic", "crane", "dockside"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace displayed_body_test
}  // namespace seam
