/// Prescribed bodies follow their path, and others collide with their own mass.

#include <gtest/gtest.h>

#include "common/physics/world.h"
#include "tests/support/scripted_world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace led_motion_test {

const char* const kNoGravity = "gravity = [0, 0]\n";

/// Two discs on a line, elastic: one of 1 kg at x = 0, one of `mass` kg at x = 3.
std::unique_ptr<World> TwoDiscs(double mass) {
  constexpr double kArea = 3.14159265 / 4;
  return SmallWorld(
      "[[part]]\nname = \"ball\"\ncircle = 0.5\nrestitution = 1\nfriction = 0\nposition = [0, 0]\n"
      "density = " +
          FloatDigits(1 / kArea) +
          "\n"
          "[[part]]\nname = \"shown\"\ncircle = 0.5\nrestitution = 1\nfriction = 0\n"
          "position = [3, 0]\ndensity = " +
          FloatDigits(mass / kArea) + "\n",
      "substeps = 1", kNoGravity);
}

constexpr int kBall = 0, kShown = 1;

/// Velocity of the ball along x after it hit the other at 6 m/s.
float Rebound(double mass, Activity activity) {
  const std::unique_ptr<World> world = TwoDiscs(mass);
  world->SetActivity(kShown, activity);
  BodyState ball = world->Read(kBall);
  ball.velocity = {6, 0};
  world->Write(kBall, ball);
  Steps(world.get(), 40);
  return world->Read(kBall).velocity.x();
}

TEST(PrescribedBody, CollidesWithItsOwnMassAndNotAsAWall) {
  for (const double mass : {2.0, 3.0, 10.0}) {
    const double free = 6 * (1 - mass) / (1 + mass);
    EXPECT_NEAR(Rebound(mass, Activity::kSimulated), free, 0.01) << mass << " kg";
    EXPECT_NEAR(Rebound(mass, Activity::kPrescribed), free, 0.01) << mass << " kg";
    EXPECT_NEAR(Rebound(mass, Activity::kKinematic), -6, 0.01) << mass << " kg";
  }
}

TEST(PrescribedBody, StrikesWithItsOwnMassToo) {
  const std::unique_ptr<World> world = TwoDiscs(1.0 / 3);
  world->SetActivity(kShown, Activity::kPrescribed);
  BodyState shown = world->Read(kShown);
  shown.velocity = {-8, 0};
  world->Write(kShown, shown);
  while (world->Read(kBall).velocity.x() == 0 && world->tick() < 60) world->Step();
  // A free one of a third of the mass: 2 m2 / (m1 + m2) of its velocity.
  EXPECT_NEAR(world->Read(kBall).velocity.x(), -4, 0.01);
}

TEST(PrescribedBody, FollowsItsPathDespiteCollisions) {
  const std::unique_ptr<World> world = TwoDiscs(3);
  world->SetActivity(kShown, Activity::kPrescribed);
  const BodyState start{{3, 0}, 0.25f, {-1, 0.125f}, 2};
  world->Write(kShown, start);
  BodyState ball = world->Read(kBall);
  ball.velocity = {20, 0};
  world->Write(kBall, ball);
  for (int tick = 1; tick <= 60; ++tick) {
    world->Step();
    const BodyState now = world->Read(kShown);
    const auto t = static_cast<float>(tick) * world->dt();
    EXPECT_EQ(now.velocity, start.velocity) << tick;
    EXPECT_EQ(now.spin, start.spin) << tick;
    // Allows for as many additions in single precision.
    EXPECT_NEAR((now.position - start.position - t * start.velocity).norm(), 0, 1e-5) << tick;
    EXPECT_NEAR(now.angle, start.angle + t * start.spin, 1e-5) << tick;
  }
  EXPECT_LT(world->Read(kBall).velocity.x(), 0) << "it was hit";
}

TEST(PrescribedBody, NeitherGravityNorAnOverlapMovesIt) {
  const std::unique_ptr<World> world = SmallWorld(
      "[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n"
      "[[part]]\nname = \"shown\"\nbox = [1, 1]\nposition = [0, 0.2]\n");
  world->SetActivity(0, Activity::kPrescribed);
  world->Write(0, BodyState{{0, 0.2f}, 0.1f, {0, 0}, 0});
  Steps(world.get(), 30);
  EXPECT_EQ(world->Read(0).position, Vec2(0, 0.2f));
  EXPECT_EQ(world->Read(0).angle, 0.1f);
}

/// Three quarters of the mass left of the root's middle.
const char* const kLopsided =
    "[[part]]\nname = \"heavy\"\nbox = [1, 1]\ndensity = 3\nposition = [10, 5]\n"
    "[[part]]\nname = \"light\"\nbox = [1, 1]\nposition = [12, 5]\n"
    "[[joint]]\nname = \"bar\"\nkind = \"weld\"\na = \"light\"\nb = \"heavy\"\n";

TEST(PrescribedBody, ItsOriginFollowsThePathIfTheMassLiesElsewhere) {
  const std::unique_ptr<World> world = SmallWorld(kLopsided, "substeps = 4", kNoGravity);
  ASSERT_EQ(world->body_count(), 1);
  world->SetActivity(0, Activity::kPrescribed);
  const BodyState start{{10, 5}, 0, {2, -1}, 4};
  world->Write(0, start);
  for (int tick = 1; tick <= 60; ++tick) {
    world->Step();
    const BodyState now = world->Read(0);
    const auto t = static_cast<float>(tick) * world->dt();
    EXPECT_NEAR((now.position - start.position - t * start.velocity).norm(), 0, 5e-5) << tick;
    EXPECT_EQ(now.velocity, start.velocity) << tick;
  }
}

TEST(PrescribedBody, AChangeOfMotionCarriesTheMotionOver) {
  const std::unique_ptr<World> world = SmallWorld(kLopsided, "substeps = 4", kNoGravity);
  const BodyState free{{10, 5}, 0.3f, {2, -1}, 4};  // of the centre of mass
  world->Write(0, free);
  for (const Activity activity :
       {Activity::kPrescribed, Activity::kKinematic, Activity::kPrescribed, Activity::kSimulated}) {
    world->SetActivity(0, activity);
    EXPECT_EQ(world->activity(0), activity);
  }
  const BodyState again = world->Read(0);
  EXPECT_EQ(again.position, free.position);
  EXPECT_NEAR((again.velocity - free.velocity).norm(), 0, 1e-5);
  EXPECT_EQ(again.spin, free.spin);
  // The origin of a turning body is not as fast as its centre of mass.
  world->SetActivity(0, Activity::kPrescribed);
  EXPECT_NEAR((world->Read(0).velocity - free.velocity).norm(), 0.5 * 4, 1e-5);
}

TEST(PrescribedBody, ABarrierKeepsItPrescribedAndReplaysTheSame) {
  const std::unique_ptr<World> world = TwoDiscs(3);
  world->SetActivity(kShown, Activity::kPrescribed);
  world->Write(kShown, BodyState{{3, 0}, 0, {-1, 0}, 1});
  BodyState ball = world->Read(kBall);
  ball.velocity = {4, 0.1f};
  world->Write(kBall, ball);
  Steps(world.get(), 10);
  const WorldSnapshot snapshot = world->Barrier();
  EXPECT_EQ(world->activity(kShown), Activity::kPrescribed);
  Steps(world.get(), 50);
  const std::uint64_t once = world->Hash();
  EXPECT_LT(world->Read(kBall).velocity.x(), 0) << "the two have met since";
  ASSERT_TRUE(world->Restore(snapshot).ok());
  EXPECT_EQ(world->activity(kShown), Activity::kPrescribed);
  Steps(world.get(), 50);
  EXPECT_EQ(world->Hash(), once);
  EXPECT_NEAR(world->Read(kShown).position.x(), 2, 1e-5);
}

TEST(PrescribedBody, ABreakElsewhereLeavesItPrescribed) {
  ScriptedWorld run(ParseScene(std::string(kNoGravity) + kLopsided +
                                   "[[part]]\nname = \"shown\"\nbox = [1, 1]\nposition = [0, 0]\n",
                               "test.toml"));
  World& world = run.world;
  world.SetActivity(run.Body("shown"), Activity::kPrescribed);
  world.Write(run.Body("shown"), BodyState{{0, 0}, 0, {3, 0}, 0});
  run.StepTo(6);
  ASSERT_EQ(world.body_count(), 2);
  ASSERT_TRUE(world.Apply({Edit(BreakEdit{0})}).has_value());
  ASSERT_EQ(world.body_count(), 3);
  EXPECT_EQ(world.activity(run.Body("shown")), Activity::kPrescribed);
  EXPECT_EQ(world.activity(run.Body("light")), Activity::kSimulated);
  run.StepTo(60);
  EXPECT_NEAR(run.Read("shown").position.x(), 3, 1e-5);
}

TEST(PrescribedBody, HalvesOfATurningBodyMoveAsTheirPlacesMoved) {
  for (const Activity activity :
       {Activity::kSimulated, Activity::kPrescribed, Activity::kKinematic}) {
    ScriptedWorld run(ParseScene(std::string(kNoGravity) + kLopsided, "test.toml"));
    BodyState turning{{10, 5}, 0, {3, 1}, 4};  // of the centre of mass, 0.5 m right of the root's
    run.world.Write(0, turning);
    run.world.SetActivity(0, activity);
    ASSERT_TRUE(run.world.Apply({Edit(BreakEdit{0})}).has_value());
    ASSERT_EQ(run.world.body_count(), 2);
    // Each half's origin is its centre of mass. Heavy is 0.5 m left of the whole's, light 1.5
    // right.
    const Vec2 heavy = run.Read("heavy").velocity, light = run.Read("light").velocity;
    EXPECT_NEAR((heavy - Vec2(3, 1 - 4 * 0.5f)).norm(), 0, 1e-5) << static_cast<int>(activity);
    EXPECT_NEAR((light - Vec2(3, 1 + 4 * 1.5f)).norm(), 0, 1e-5) << static_cast<int>(activity);
    EXPECT_EQ(run.Read("light").spin, 4);
  }
}

TEST(PrescribedBody, BothHalvesOfABrokenOneArePrescribed) {
  ScriptedWorld run(ParseScene(std::string(kNoGravity) + kLopsided, "test.toml"));
  run.world.SetActivity(0, Activity::kPrescribed);
  run.world.Write(0, BodyState{{10, 5}, 0, {3, 0}, 0});
  ASSERT_TRUE(run.world.Apply({Edit(BreakEdit{0})}).has_value());
  for (const char* half : {"heavy", "light"}) {
    EXPECT_EQ(run.world.activity(run.Body(half)), Activity::kPrescribed) << half;
  }
  run.StepTo(60);
  EXPECT_NEAR(run.Read("heavy").position.x(), 13, 1e-4);
  EXPECT_NEAR(run.Read("light").position.x(), 15, 1e-4);
}

/// A disc that was only shown, or nowhere, at rest in the air, and is let go: metres that it falls
/// in half a second.
float FallsOnceSimulated(Activity shown, const std::string& sleep) {
  const Scene scene = ParseScene("[solver]\nsleep = " + sleep +
                                     "\n[[part]]\nname = \"disc\"\ncircle = 0.5\n"
                                     "position = [0, 5]\n",
                                 "test.toml");
  World world(scene);
  world.SetActivity(0, shown);
  world.SetAwake(0, false);
  Steps(&world, 3);
  world.SetActivity(0, Activity::kSimulated);
  world.SetAwake(0, false);  // as it was
  Steps(&world, 30);
  return 5 - world.Read(0).position.y();
}

TEST(PrescribedBody, WithoutSleepABodyFallsOnceItIsSimulated) {
  for (const Activity shown : {Activity::kKinematic, Activity::kPrescribed, Activity::kDisplayed}) {
    EXPECT_NEAR(FallsOnceSimulated(shown, "false"), 10 * 0.5 * 0.5 / 2, 0.1);
    EXPECT_EQ(FallsOnceSimulated(shown, "true"), 0) << "it sleeps on, as it is told";
  }
}

}  // namespace led_motion_test
}  // namespace seam
