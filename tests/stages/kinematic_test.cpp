/// Kinematic parts follow their path exactly, for every peer and latecomer, and carry their load.

#include "common/stages/kinematic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/measure/joint_drift.h"
#include "common/measure/overlap.h"
#include "common/physics/part_places.h"
#include "tests/support/small_world.h"

namespace seam {
namespace kinematic_test {

std::string Platform(const std::string& motion, const std::string& rest = "") {
  return "[[part]]\nname = \"platform\"\nbox = [4, 0.5]\nposition = [1, 2]\nanchored = true\n" +
         rest + "[[joint]]\nname = \"mover\"\nkind = \"kinematic\"\nb = \"platform\"\n" + motion +
         "\n";
}

ImposedMotions MotionsOf(const Scene& scene) { return ImposedMotions(scene, Compose(scene)); }

BodyState At(const std::string& motion, double tick) {
  return MotionsOf(ParseScene(Platform(motion), "s.toml")).At(0, tick);
}

TEST(Kinematic, ThePathIsTravelledAtOneSpeedAndClosed) {
  // 3-4-5: 12 m in 6 s are 2 m/s.
  const std::string path = "path = [[0, 0], [3, 0], [3, 4]]\nperiod = 6";
  const auto place = [&](double seconds) { return At(path, seconds * 60).position; };
  EXPECT_NEAR((place(0) - Vec2(1, 2)).norm(), 0, 1e-6);
  EXPECT_NEAR((place(1) - Vec2(3, 2)).norm(), 0, 1e-5);
  EXPECT_NEAR((place(2.5) - Vec2(4, 4)).norm(), 0, 1e-5);
  EXPECT_NEAR((place(3.5) - Vec2(4, 6)).norm(), 0, 1e-5);
  EXPECT_NEAR((place(4.75) - Vec2(2.5f, 4)).norm(), 0, 1e-5);
  EXPECT_NEAR((place(601) - Vec2(3, 2)).norm(), 0, 1e-4) << "a hundred laps later";
  EXPECT_NEAR(At(path, 60).velocity.x(), 2, 1e-5);
  EXPECT_NEAR((At(path + "\nphase = 0.25", 60).position - Vec2(4, 4)).norm(), 0, 1e-5);
}

TEST(Kinematic, EasingStopsAtEachPoint) {
  const std::string path = "path = [[0, 0], [0, 3]]\nperiod = 4\nease = true";
  const double pi = 3.141592653589793;
  for (int t = 0; t <= 120; t += 10) {
    const BodyState state = At(path, t);
    EXPECT_NEAR(state.position.y(), 2 + 1.5 * (1 - std::cos(pi * t / 120)), 1e-5) << t;
    EXPECT_NEAR(state.velocity.y(), 1.5 * pi / 2 * std::sin(pi * t / 120), 1e-5) << t;
  }
}

TEST(Kinematic, TurningIsAboutTheAnchor) {
  const BodyState state = At("turning = 0.5\nanchor = [0, 2]", 60);
  EXPECT_NEAR(state.angle, 0.5, 1e-6);
  EXPECT_NEAR(state.position.x(), std::cos(0.5), 1e-6);
  EXPECT_NEAR(state.position.y(), 2 + std::sin(0.5), 1e-6);
  EXPECT_NEAR(state.velocity.norm(), 0.5, 1e-6);
}

TEST(Kinematic, CarriesItsLoad) {
  for (const char* solver : {"", "substeps = 3"}) {
    const auto world =
        SmallWorld(Platform("path = [[0, 0], [40, 0]]\nperiod = 40") +
                       "[[part]]\nname = \"box\"\nbox = [0.5, 0.5]\nposition = [1, 2.515]\n",
                   solver);
    Steps(world.get(), 120);
    const BodyState now = world->Read(0);
    EXPECT_NEAR(now.velocity.x(), 2, 1e-3);
    Steps(world.get(), 60);
    EXPECT_NEAR(world->Read(0).position.x() - now.position.x(), 2, 1e-3);
    EXPECT_NEAR(world->Read(0).position.y(), 2.515, 5e-3);
  }
}

TEST(Kinematic, ItLiftsAndLowersAtItsOwnSpeed) {
  const auto world = SmallWorld(Platform("path = [[0, 0], [0, 6]]\nperiod = 8") +
                                "[[part]]\nname = \"box\"\nbox = [0.5, 0.5]\n"
                                "position = [1, 2.515]\n");
  Steps(world.get(), 180);
  EXPECT_NEAR(world->Read(0).velocity.y(), 1.5, 0.01);
  EXPECT_NEAR(world->Read(0).position.y(), 2.515 + 4.5, 0.01);
  Steps(world.get(), 240);
  EXPECT_NEAR(world->Read(0).velocity.y(), -1.5, 0.01);
}

/// A world in which a box falls on the platform at the end of its path and rides.
std::string Ride() {
  return Platform("path = [[0, 0], [5, 1], [0, 2]]\nperiod = 7\nturning = 0.02\nanchor = [0, 2]") +
         "[[part]]\nname = \"box\"\nbox = [0.5, 0.5]\nposition = [1.4, 3]\n"
         "[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [0.4, 3]\n"
         "[[joint]]\nname = \"hung\"\nkind = \"rope\"\na = \"platform\"\nb = \"ball\"\n"
         "anchor_a = [-1, 2]\nlength = 3\n";
}

TEST(Kinematic, FollowsItsPathExactlyAtEveryTick) {
  // Observed through a body hung from it by a rigid rod: the rod's length is the proof.
  const Scene scene = ParseScene("[solver]\nsleep = false\n" + Ride(), "s.toml");
  World world(scene);
  const JointMeter meter(scene, Compose(scene));
  const OverlapMeter overlap(scene, Compose(scene));
  for (int t = 1; t <= 600; ++t) {
    world.Step();
    const std::vector<BodyState> states = {world.Read(0), world.Read(1)};
    ASSERT_LT(meter.Worst(states, world.tick()), 0.01) << t;
    ASSERT_LT(overlap.Deepest(states, world.tick()), 0.02) << t;
  }
}

TEST(Kinematic, ALatecomerHasItAtTheSamePlace) {
  // Contact tells where it is: a box put on it at tick 500 rides as one in a world from the start.
  const Scene scene = ParseScene(Ride(), "s.toml");
  World from_start(scene), late(scene);
  while (from_start.tick() < 500) from_start.Step();
  late.SetTick(500);
  const BodyState place = MotionsOf(scene).At(0, 500);
  for (World* world : {&from_start, &late}) {
    BodyState box{place.position + Vec2(0.3f, 0.8f), 0, {0, 0}, 0};
    world->Write(0, box);
    world->Write(1, {place.position + Vec2(-0.8f, 1), 0, {0, 0}, 0});
    for (int t = 0; t < 60; ++t) world->Step();
  }
  for (int body = 0; body < 2; ++body) {
    EXPECT_NEAR((from_start.Read(body).position - late.Read(body).position).norm(), 0, 0.02);
  }
  EXPECT_LT((late.Read(0).position - MotionsOf(scene).At(0, 560).position).norm(), 2) << "rides";
}

TEST(Kinematic, ReplaysBitForBitFromABarrier) {
  World world(ParseScene(Ride(), "s.toml"));
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  while (world.tick() < 300) {
    world.Step();
    if (world.tick() % 4 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  for (const std::size_t from : {5, 40}) {
    EXPECT_TRUE(world.Restore(barriers[from]).ok());
    while (world.tick() < 300) {
      world.Step();
      if (world.tick() % 4 == 0) world.Barrier();
      ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick() - 1)]) << world.tick();
    }
  }
}

TEST(Kinematic, NobodyOwnsIt) {
  const Scene scene = ParseScene(Ride(), "s.toml");
  const Composition composition = Compose(scene);
  EXPECT_EQ(composition.mechanisms.size(), 2u) << "the box and the ball, not joined by it";
  EXPECT_TRUE(composition.assemblies[0].anchored);
  EXPECT_EQ(composition.assemblies[0].kinematic, 0);
  EXPECT_EQ(composition.assemblies[0].mechanism, -1);
  World world(scene);
  EXPECT_EQ(world.body_count(), 2);
}

TEST(Kinematic, IsReadWhereItIs) {
  const auto world = SmallWorld(Platform("path = [[0, 0], [0, 4]]\nperiod = 8"));
  Steps(world.get(), 60);
  BodyState state;
  ASSERT_TRUE(ReadPart(*world, 0, &state));
  EXPECT_NEAR(state.position.y(), 3, 1e-4);
  EXPECT_NEAR(state.velocity.y(), 1, 1e-4);
}

TEST(Kinematic, IsPutBackAtOnceWithoutItsJoint) {
  const auto world = SmallWorld(Platform("path = [[0, 0], [0, 4]]\nperiod = 8"));
  Steps(world.get(), 60);
  EXPECT_TRUE(world->Apply({Edit(BreakEdit{0}, EditCause::kOutside)}).has_value());
  for (const int ticks : {0, 1, 60}) {
    Steps(world.get(), ticks);
    const BodyState state = world->ReadAssembly(0);
    EXPECT_EQ(state.position, Vec2(1, 2)) << ticks;
    EXPECT_EQ(state.velocity, Vec2(0, 0)) << ticks;
  }
}

TEST(Kinematic, GlueOnItBreaksAsOnWhatStandsStill) {
  const std::string rest = R"([[part]]
name = "shelf"
box = [1, 1]
position = [2, 2.75]
[[part]]
name = "ball"
circle = 0.4
position = [2, 5]
velocity = [0, -10]
density = 6
[[joint]]
name = "glue"
kind = "glue"
a = "platform"
b = "shelf"
strength = 150
)";
  for (const double strength : {150.0, 150000.0}) {
    std::string text = rest;
    text.replace(text.find("150"), 3, FloatDigits(strength));
    const auto world = SmallWorld(Platform("path = [[0, 0], [0, 2]]\nperiod = 500", text));
    int broken = 0;
    for (int tick = 0; tick < 60; ++tick) {
      world->Step();
      for (const Edit& edit : world->ProposeEdits()) broken += edit.As<BreakEdit>() != nullptr;
    }
    EXPECT_EQ(broken > 0, strength < 1000) << strength;
  }
}

}  // namespace kinematic_test
}  // namespace seam
