/// pvb: the goal of the blended path, and that it never jumps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/sync/reconcile/reconcile.h"
#include "tests/support/followed_copy.h"

namespace seam {
namespace reconcile_pvb_test {

/// Follows the rule through one blend of `interval` with no force but `g`, and the authority's path
/// `there(t)`. The copy's end state; `worst_move` is the largest way in one tick.
template <typename There>
BodyState Blend(BodyState local, float interval, float g, const There& there, float* worst_move) {
  PullMemory memory;
  PullInput in;
  in.step = 1.0f / 60;
  in.interval = interval;
  in.arrival = local;
  in.target_then = there(0);
  in.drift.velocity = Vec2(0, g * in.step);
  in.drift.position = Vec2(0, g * in.step * in.step);
  const int ticks = static_cast<int>(std::lround(interval * 60));
  for (int i = 0; i < ticks; ++i) {
    in.local = local;
    in.since_arrival = static_cast<float>(i) * in.step;
    in.target = there(in.since_arrival);
    in.target_next = there(in.since_arrival + in.step);
    const Correction c = PullPvb(in, &memory);
    EXPECT_EQ(c.now.position.norm(), 0) << "the pose is the step's business";
    memory.before = local.velocity;
    memory.asked = c.now.velocity;
    local.velocity += c.now.velocity + in.drift.velocity;
    local.spin += c.now.spin;
    local.position += in.step * local.velocity;
    local.angle += in.step * local.spin;
    *worst_move = std::max(*worst_move, in.step * local.velocity.norm());
  }
  return local;
}

TEST(Pvb, MeetsAUniformlyMovingAuthorityExactlyAtTheEndOfTheBlend) {
  const auto there = [](float t) {
    BodyState s;
    s.position = Vec2(3 + 4 * t, 1 - 2 * t);
    s.velocity = Vec2(4, -2);
    s.angle = 0.5f + 1.5f * t;
    s.spin = 1.5f;
    return s;
  };
  BodyState local;
  local.velocity = Vec2(1, 5);
  float worst = 0;
  for (const float interval : {0.3f, 0.5f, 1.0f}) {
    const BodyState end = Blend(local, interval, -10, there, &worst);
    EXPECT_NEAR((end.position - there(interval).position).norm(), 0, 1e-5) << interval;
    EXPECT_NEAR(end.angle, there(interval).angle, 1e-5) << interval;
  }
}

TEST(Pvb, MeetsAFallingAuthorityToo) {
  const auto there = [](float t) {
    BodyState s;
    s.position = Vec2(1 + 4 * t, 2 - 5 * t * t);
    s.velocity = Vec2(4, -10 * t);
    return s;
  };
  float worst = 0;
  const BodyState end = Blend(BodyState{}, 0.5f, -10, there, &worst);
  EXPECT_NEAR((end.position - there(0.5f).position).norm(), 0, 1e-5);
}

TEST(Pvb, GoesEvenlyFromRestToRest) {
  // From rest at 0 to rest at 1: Q = T P' = T, and half way in time is half the way.
  const auto there = [](float) {
    BodyState s;
    s.position = Vec2(1, 0);
    return s;
  };
  float worst = 0;
  const BodyState end = Blend(BodyState{}, 0.5f, 0, there, &worst);
  EXPECT_NEAR(end.position.x(), 1, 1e-5);
  EXPECT_NEAR(worst, 1.0f / 30, 1e-5) << "30 ticks, one as long as the other";
}

TEST(Pvb, NeverJumpsOnAnyMessage) {
  // The authority's ball is kicked; the copy hears of it 9 ticks later and flies after it.
  FollowedCopy f(
      "gravity = [0, 0]\n[solver]\nsleep = false\n"
      "[[part]]\nname = \"a\"\nbox = [1, 1]\nvelocity = [3, 0]\n",
      "pvb", 9);
  f.Steps(30);
  BodyState kicked = f.truth.Read(0);
  kicked.velocity = Vec2(-3, 5);
  f.truth.Write(0, kicked);
  float worst = 0;
  for (int t = 0; t < 60; ++t) {
    const BodyState before = f.copy.world().Read(0);
    f.Step();
    const BodyState after = f.copy.world().Read(0);
    worst = std::max(
        worst, (after.position - before.position - f.copy.world().dt() * after.velocity).norm());
  }
  EXPECT_LT(worst, 1e-4f) << "all that it moves, it moves by its velocity";
  EXPECT_LT(f.Apart(0).norm(), 0.01f);
}

TEST(Pvb, AnImpactEndsTheBlendUntilTheNextMessage) {
  PullMemory memory;
  PullInput in;
  in.step = 1.0f / 60;
  in.target.position = in.target_next.position = in.target_then.position = Vec2(1, 0);
  const Correction first = PullPvb(in, &memory);
  EXPECT_GT(first.now.velocity.x(), 1);
  memory.asked = first.now.velocity;
  in.since_arrival = in.step;
  in.local.velocity = Vec2(0, 0);  // it ran into something
  EXPECT_EQ(PullPvb(in, &memory).now.velocity.norm(), 0);
  in.since_arrival = 2 * in.step;
  EXPECT_EQ(PullPvb(in, &memory).now.velocity.norm(), 0);
  in.since_arrival = 0;
  EXPECT_GT(PullPvb(in, &memory).now.velocity.x(), 1);
}

TEST(Pvb, PlacesOnlyDistantCopies) {
  ReconcileInput in;
  in.remote.position = Vec2(7.9f, 0);
  EXPECT_EQ(ReconcilePvb(in).now.position.norm(), 0);
  in.remote.position = Vec2(8.1f, 0);
  EXPECT_FLOAT_EQ(ReconcilePvb(in).now.position.x(), 8.1f);
}

}  // namespace reconcile_pvb_test
}  // namespace seam
