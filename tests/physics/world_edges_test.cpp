/// World at its edges: non-finite values, single bits, limits of joints, moved bodies.

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/small_world.h"

namespace seam {
namespace world_edges_test {

std::string Box(const char* name, double x, double y, const char* more = "") {
  return std::string("[[part]]\nname = \"") + name + "\"\nbox = [1, 1]\nposition = [" +
         FloatDigits(x) + ", " + FloatDigits(y) + "]\n" + more + "\n";
}

const char* const kGround = "[[part]]\nname=\"ground\"\nchain=[[-50, 0], [50, 0]]\n";

TEST(WorldEdges, MovingAssembliesAreNumberedByTheirIds) {
  const auto world = SmallWorld(std::string(kGround) + Box("a", 0, 1) + Box("b", 5, 1) +
                                Box("post", 9, 1, "anchored = true") + Box("c", 12, 1));
  ASSERT_EQ(world->body_count(), 3);
  EXPECT_EQ(world->id(0), 1);
  EXPECT_EQ(world->id(2), 4);
  EXPECT_EQ(world->BodyOfId(4), 2);
  EXPECT_EQ(world->BodyOfId(0), -1);
  EXPECT_EQ(world->BodyOfId(3), -1);
  EXPECT_EQ(world->BodyOfId(99), -1);
  EXPECT_EQ(world->mechanism(2), 2);
  world->SetTick(500);
  world->Step();
  EXPECT_EQ(world->tick(), 501);
}

TEST(WorldEdgesDeathTest, WriteRefusesNonFiniteStates) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto world = SmallWorld(Box("a", 0, 0));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const BodyState bad[] = {{{nan, 0}, 0, {0, 0}, 0},
                           {{0, inf}, 0, {0, 0}, 0},
                           {{0, 0}, nan, {0, 0}, 0},
                           {{0, 0}, 0, {0, -inf}, 0},
                           {{0, 0}, 0, {0, 0}, nan}};
  for (const BodyState& state : bad) {
    EXPECT_DEATH(world->Write(0, state), "assertion failed");
  }
  EXPECT_DEATH(world->Read(1), "assertion failed");
  EXPECT_DEATH(world->Read(-1), "assertion failed");
}

TEST(WorldEdges, HashSeesEveryBitOfEveryField) {
  const Scene sleeps = ParseScene(Box("a", 0, 0) + Box("b", 5, 0), "test.toml");
  const auto world = std::make_unique<World>(sleeps);
  std::uint64_t last = world->Hash();
  const auto changed = [&] {
    const std::uint64_t before = last;
    last = world->Hash();
    return last != before;
  };
  EXPECT_FALSE(changed());
  world->SetTick(1);
  EXPECT_TRUE(changed());
  BodyState s = world->Read(1);
  s.position.x() = std::nextafter(s.position.x(), 9.0f);
  world->Write(1, s);
  EXPECT_TRUE(changed());
  s.angle = 1e-30f;
  world->Write(1, s);
  EXPECT_TRUE(changed());
  s.velocity.y() = 1e-30f;
  world->Write(1, s);
  EXPECT_TRUE(changed());
  s.spin = -0.0f;  // equal to what it was, but not bit for bit
  world->Write(1, s);
  EXPECT_TRUE(changed());
  world->SetAwake(0, false);
  EXPECT_TRUE(changed());
}

TEST(WorldEdges, MovedBodyFindsItsNewContacts) {
  const auto world = SmallWorld(kGround + Box("crate", 0, 20));
  Steps(world.get(), 10);
  world->Write(0, {{30, 0.52f}, 0, {0, 0}, 0});
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).position.y(), 0.515, 0.005);
}

TEST(WorldEdges, SmallWritesLeaveAStackItsWarmContacts) {
  // A correction of 1 mm a tick to one box, there and back: with its contacts' impulses lost each
  // time, the stack above it would sink in and be thrown out.
  std::string stack = kGround;
  for (int i = 0; i < 6; ++i) {
    stack += Box(("b" + std::to_string(i)).c_str(), 0, 0.515 + 1.015 * i);
  }
  const auto world = SmallWorld(stack);
  Steps(world.get(), 60);
  const float height = world->Read(5).position.y();
  for (int tick = 0; tick < 300; ++tick) {
    BodyState state = world->Read(2);
    state.position.x() += tick % 2 == 0 ? 0.001f : -0.001f;
    world->Write(2, state);
    world->Step();
    ASSERT_NEAR(world->Read(5).position.y(), height, 0.02) << tick;
  }
}

TEST(WorldEdges, WheelWithoutASpringDoesNotSag) {
  const auto world = SmallWorld(
      "[[part]]\nname=\"frame\"\nbox=[4, 1]\nanchored=true\n"
      "[[part]]\nname=\"wheel\"\ncircle=0.5\nposition=[0, -2]\ndensity=100\n"
      "[[joint]]\nname=\"axle\"\nkind=\"wheel\"\na=\"frame\"\nb=\"wheel\"\n");
  Steps(world.get(), 300);
  EXPECT_NEAR(world->Read(0).position.x(), 0, 0.005);  // within Box2D's slop of 5 mm
  EXPECT_NEAR(world->Read(0).position.y(), -2, 0.0051);
}

TEST(WorldEdges, RevoluteLimitsStopTheSwing) {
  const auto world = SmallWorld(
      "[[part]]\nname=\"hook\"\nbox=[0.2, 0.2]\nanchored=true\n"
      "[[part]]\nname=\"bar\"\nbox=[2, 0.2]\nposition=[1, 0]\n"
      "[[joint]]\nname=\"hinge\"\nkind=\"revolute\"\na=\"hook\"\nb=\"bar\"\nanchor=[0, 0]\n"
      "limits=[-0.5, 0.5]\n");
  Steps(world.get(), 300);
  EXPECT_NEAR(world->Read(0).angle, -0.5, 0.05);  // within its slop of 2 degrees
}

TEST(WorldEdges, EnergyIsKineticAndPotential) {
  const auto world = SmallWorld(Box("a", 3, 4, "velocity=[3, 4]\nspin=2\ndensity=5"));
  EXPECT_NEAR(world->Energy(), 5 * (25 / 2.0 + 10 * 4) + 5 / 6.0 * 4 / 2, 1e-4);
}

TEST(WorldEdges, ImpactsOfATickAreTheSameInAnySubsteps) {
  // Impulse = (1 + e) m1 m2/(m1 + m2) v: the lighter one feels the larger change of speed.
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const int substeps : {1, 4}) {
      const std::string ball = "circle = 0.5\nfriction = 0\nrestitution = " + FloatDigits(e) + "\n";
      const auto world =
          SmallWorld("[[part]]\nname=\"heavy\"\ndensity=3\nposition=[-3, 0]\nvelocity=[6, 0]\n" +
                         ball + "[[part]]\nname=\"light\"\n" + ball,
                     "substeps = " + std::to_string(substeps), "gravity = [0, 0]");
      std::vector<Impact> impacts;
      for (int tick = 0; tick < 60; ++tick) {
        world->Step();
        impacts.insert(impacts.end(), world->impacts().begin(), world->impacts().end());
      }
      ASSERT_EQ(impacts.size(), 1u) << e << " " << substeps;
      EXPECT_NEAR(impacts[0].dv, (1 + e) * 3 / 4.0 * 6, 1e-4) << e << " " << substeps;
      // Positions after the step: 0.1 m of overlap and as much of parting.
      EXPECT_NEAR((impacts[0].point - Vec2(-0.5f, 0)).norm(), 0, 0.2);
    }
  }
}

}  // namespace world_edges_test
}  // namespace seam
