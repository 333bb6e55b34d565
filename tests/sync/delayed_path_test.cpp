/// Bodies shown in the past: between received states, and beyond the newest by dead reckoning.

#include "common/sync/show/delayed_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/scene/scene.h"
#include "tests/support/small_world.h"

namespace seam {
namespace delayed_path_test {

TEST(Snapshots, InterpolateBetweenAndHoldBeyond) {
  constexpr float kDt = 1 / 60.0f;
  const Vec2 gravity(0, -10);
  const BodyTable bodies(1, 0);
  Snapshots snapshots(bodies);
  BodyState s;
  s.velocity = Vec2(6, 0);
  s.position = Vec2(1, 0);
  snapshots.Add(0, 10, s);
  s.position = Vec2(2, 0);
  snapshots.Add(0, 20, s);
  snapshots.Add(0, 15, BodyState{});
  EXPECT_FLOAT_EQ(snapshots.Interpolate(0, 15, kDt, gravity, true).position.x(), 1.5f)
      << "older news is not taken";
  EXPECT_FLOAT_EQ(snapshots.Interpolate(0, 25, kDt, gravity, true).position.x(), 2)
      << "never extrapolated";
  EXPECT_FLOAT_EQ(snapshots.Interpolate(0, 5, kDt, gravity, true).position.x(), 1);
  EXPECT_FLOAT_EQ(snapshots.Extrapolate(0, 26, 1 / 60.0f, 0.5f).position.x(), 2.6f);
  EXPECT_FLOAT_EQ(snapshots.Extrapolate(0, 2000, 1 / 60.0f, 0.5f).position.x(), 5);
}

TEST(Snapshots, InterpolateAFallAlongItsParabolaAndATurnByItsSpin) {
  const BodyTable bodies(1, 0);
  Snapshots snapshots(bodies);
  const Vec2 gravity(0, -10);
  BodyState s;
  s.velocity = Vec2(3, 4);
  s.spin = 9;
  snapshots.Add(0, 0, s);
  s.position = Vec2(1.5f, 0.75f);  // half a second later
  s.velocity = Vec2(3, -1);
  s.angle = WrapAngle(4.6f);
  snapshots.Add(0, 30, s);
  const BodyState half = snapshots.Interpolate(0, 15, 1 / 60.0f, gravity, true);
  EXPECT_NEAR(half.position.x(), 0.75f, 1e-5f);
  EXPECT_NEAR(half.position.y(), 4 * 0.25f - 5 * 0.0625f, 1e-5f);
  EXPECT_NEAR(WrapAngle(half.angle - 2.3f), 0, 1e-5f) << "not backwards, the shorter way";
}

TEST(Snapshots, InterpolateABounceAtItsPlaceHoweverLongBetweenStates) {
  constexpr float kDt = 1 / 60.0f;
  const BodyTable bodies(1, 0);
  for (const int ticks : {2, 36}) {
    for (const float share : {0.1f, 0.4f, 0.9f}) {
      Snapshots snapshots(bodies);
      const float whole = static_cast<float>(ticks) * kDt, blow = share * whole;
      const auto truth = [&](float at) {
        BodyState s;
        s.position = Vec2(4 * std::min(at, blow) - 3 * std::max(at - blow, 0.0f), 2 * at);
        s.velocity = Vec2(at < blow ? 4 : -3, 2);
        s.spin = at < blow ? 1 : 5;
        s.angle = std::min(at, blow) + 5 * std::max(at - blow, 0.0f);
        return s;
      };
      snapshots.Add(0, 0, truth(0));
      snapshots.Add(0, ticks, truth(whole));
      for (int n = 0; n < 20; ++n) {
        const double tick = ticks * n / 20.0;
        const BodyState wanted = truth(static_cast<float>(tick) * kDt);
        const BodyState shown = snapshots.Interpolate(0, tick, kDt, Vec2(0, 0), true);
        EXPECT_LT((shown.position - wanted.position).norm(), 1e-4f) << ticks << " " << share;
        EXPECT_NEAR(shown.angle, wanted.angle, 1e-4f) << ticks << " " << share;
      }
    }
  }
}

TEST(DisplayDelay, CoversNearlyAllArrivalsAndMovesSlowly) {
  DisplayDelay delay(2);
  for (int i = 0; i < 90; ++i) delay.AddAge(i % 10 == 0 ? 9 : 6);
  EXPECT_NEAR(delay.Advance(), 13, 0.1) << "p95 of 6 and 9, plus two intervals";
  for (int i = 0; i < 90; ++i) delay.AddAge(20);
  const double before = delay.ticks();
  EXPECT_LE(delay.Advance() - before, 0.0201);
}

/// A disc shown 13 ticks late (states are 9 ticks old on arrival, and come every 2 ticks).
struct DelayedPathTest : ::testing::Test {
  DelayedPathTest() {
    for (int i = 0; i < 90; ++i) path.AddAge(9);
  }
  void Tell(std::int64_t tick, const Vec2& position, const Vec2& velocity, bool falls = false) {
    BodyState state;
    state.position = position;
    state.velocity = velocity;
    snapshots.Add(0, tick, state, falls);
  }
  World world{ParseScene("gravity = [0, -10]\n[[part]]\nname = \"disc\"\ncircle = 0.5\n", "disc")};
  BodyTable bodies{world};
  Snapshots snapshots{bodies};
  DelayedPath path{world, snapshots, 2};
};

TEST_F(DelayedPathTest, AMissingStateIsReckonedAtTheSpeedThatWasTold) {
  Tell(100, {5, 0}, {3, 0});
  for (std::int64_t next = 114; next <= 160; ++next) {
    path.Begin(next);
    const double shown = static_cast<double>(next - 1 - 13 - 100) / 60;
    EXPECT_NEAR(path.Here(0).position.x(), 5 + 3 * shown, 1e-4) << next;
    EXPECT_NEAR(path.Speed(0).velocity.x(), 3, 1e-3) << next;
  }
}

TEST_F(DelayedPathTest, OneLostStateOfARegularStreamChangesNothing) {
  for (std::int64_t tick = 80; tick <= 200; tick += 2) {
    if (tick != 110) Tell(tick, {0.05f * static_cast<float>(tick), 0}, {3, 0});
  }
  for (std::int64_t next = 100; next <= 200; ++next) {
    path.Begin(next);
    EXPECT_NEAR(path.Speed(0).velocity.x(), 3, 1e-3) << next;
  }
}

TEST_F(DelayedPathTest, AFallGoesOnBetweenAndBeyondStates) {
  // 4 m up, falling from rest at tick 100; the second state is of half a second later.
  Tell(100, {0, 4}, {0, 0}, true);
  path.Begin(100 + 13 + 31);
  EXPECT_NEAR(path.Here(0).position.y(), 4 - 5 * 0.25f, 0.06f) << "beyond";
  Tell(130, {0, 2.75f}, {0, -5}, true);
  path.Begin(100 + 13 + 16);
  EXPECT_NEAR(path.Here(0).position.y(), 4 - 5 * 0.0625f, 0.01f) << "between";
}

TEST_F(DelayedPathTest, BodiesStayWhereTheyBeganUntilSomethingIsHeard) {
  DelayedPath fresh(world, snapshots, 2);
  Tell(0, {1, 1}, {30, 0});
  for (std::int64_t next = 1; next < 20; ++next) {
    fresh.Begin(next);
    EXPECT_EQ(fresh.Here(0).position, Vec2(1, 1));
    EXPECT_EQ(fresh.Speed(0).velocity, Vec2(0, 0));
  }
}

}  // namespace delayed_path_test
}  // namespace seam
