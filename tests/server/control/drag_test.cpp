/// The spring of a hand that drags a body: where it holds, how fast it draws, and how hard.

#include "server/control/drag.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "tests/support/small_world.h"

namespace seam {
namespace drag_test {

constexpr int kEvery = 3;  // ticks of 1/60 s between two pushes

std::unique_ptr<World> Boxes(const std::string& gravity) {
  return SmallWorld(R"(
[[part]]
name = "ground"
chain = [[-300, -5], [300, -5]]
[[part]]
name = "box"
box = [2, 1]
position = [0, 0]
density = 3
[[part]]
name = "far"
box = [1, 1]
position = [100, 0]
anchored = true
)",
                    "", "gravity = " + gravity);
}

float Seconds(const World& world) { return kEvery * world.dt(); }

/// Returns the place of the gripped point.
Vec2 PointOf(const World& world, const Grip& grip) {
  const BodyState at = PartPose(world, grip.part);
  return at.position + Turned(grip.point, at.angle);
}

/// Drags for so many ticks; returns the largest impulse, N s.
float Drag(World* world, const Grip& grip, int ticks) {
  float most = 0;
  for (int i = 0; i < ticks; ++i) {
    if (i % kEvery == 0) {
      const std::optional<PushEdit> push = DragPush(*world, grip, Seconds(*world));
      EXPECT_TRUE(push);
      if (!push) return most;
      most = std::max(most, push->impulse.norm());
      world->Apply({Edit(*push, EditCause::kOutside)});
    }
    world->Step();
  }
  return most;
}

TEST(Drag, BringsThePointToTheTargetAndHoldsItThere) {
  const auto world = Boxes("[0, 0]");
  const Grip middle{1, Vec2(0, 0), Vec2(3, 2)};
  Drag(world.get(), middle, 180);
  EXPECT_LT((PointOf(*world, middle) - middle.target).norm(), 0.001f);
  EXPECT_LT(world->Read(0).velocity.norm(), 0.001f);
  // By a corner it turns about the hand, as a pendulum without gravity.
  const Grip corner{1, Vec2(0.9f, 0.4f), Vec2(0, 0)};
  Drag(world.get(), corner, 180);
  EXPECT_LT((PointOf(*world, corner) - corner.target).norm(), 0.1f);
  const float spin = std::abs(world->Read(0).spin);
  Drag(world.get(), corner, 600);
  EXPECT_LE(std::abs(world->Read(0).spin), spin * 1.01f) << "and gains nothing by it";
}

TEST(Drag, SettlesWithoutSwingingBeyondTheTarget) {
  const auto world = Boxes("[0, 0]");
  const Grip middle{1, Vec2(0, 0), Vec2(4, 0)};
  float farthest = 0;
  for (int i = 0; i < 60; ++i) {
    Drag(world.get(), middle, kEvery);
    farthest = std::max(farthest, PointOf(*world, middle).x());
  }
  EXPECT_NEAR(farthest, 4, 0.05) << "critical damping does not overshoot";
}

TEST(Drag, ABodyHangsAsFarBelowTheHandAsItsSpringIsSoft) {
  const auto world = Boxes("[0, -9.81]");
  const Grip middle{1, Vec2(0, 0), Vec2(0, 3)};
  Drag(world.get(), middle, 240);
  // Each push gives back the speed g T, and the body is as high before each: so it falls with 1.5
  // ticks' less than half of that at a push (the engine adds gravity before it moves a body).
  const double w = 2 * M_PI * double{kDragHz}, t = double{Seconds(*world)}, g = 9.81;
  const double way = 2 * w + t * w * w, falls = g * t - 2 * g * double{world->dt()};
  const double stretch = (g * t * (1 + 1 / (t * way)) - falls) * way / (w * w);
  EXPECT_NEAR(3 - PointOf(*world, middle).y(), stretch, 0.002);
  EXPECT_NEAR(stretch, 0.13, 0.005) << "as the documentation says";
}

TEST(Drag, IsBoundedByTheMassAndTheSpeedLimit) {
  const auto world = Boxes("[0, 0]");
  const float mass = world->mass(0);
  const Grip far{1, Vec2(0, 0), Vec2(900, 0)};
  const float most = Drag(world.get(), far, 90);
  EXPECT_LE(most, Seconds(*world) * kDragForcePerKg * mass * 1.0001f);
  EXPECT_GT(most, 0);
  EXPECT_LT(world->Read(0).velocity.norm(), world->scene().speed_limit / 4 + 1);
  EXPECT_GT(world->Read(0).velocity.norm(), world->scene().speed_limit / 8);
}

TEST(Drag, KeepsTheTargetWithinTheBounds) {
  const auto world = SmallWorld(R"(
[[part]]
name = "box"
box = [1, 1]
position = [0, 0]
)",
                                "", "gravity = [0, 0]\nbounds = [[-5, -5], [5, 5]]");
  Drag(world.get(), {0, Vec2(0, 0), Vec2(80, 0)}, 240);
  EXPECT_NEAR(world->Read(0).position.x(), 5 - kDragMargin, 0.05);
}

TEST(Drag, HasNothingToPushWhereNothingMoves) {
  const auto world = Boxes("[0, 0]");
  for (const PartId part : {0, 2, 3, 99, -1}) {
    EXPECT_FALSE(DragPush(*world, {part, Vec2(0, 0), Vec2(1, 1)}, 0.05f)) << part;
  }
}

}  // namespace drag_test
}  // namespace seam
