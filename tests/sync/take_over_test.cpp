/// A copy that receives the exact state of its body's last holder.

#include <gtest/gtest.h>

#include <string>

#include "tests/support/followed_copy.h"

namespace seam {
namespace take_over_test {

const char* const kFlying =
    "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [0, 30]\nvelocity = [4, 0]\n";
constexpr int kLate = 6;

ExactStates Exact(const World& world, std::int32_t epoch) {
  ExactStates exact;
  exact.tick = world.tick();
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    exact.id.push_back(world.id(body));
    exact.epoch.push_back(epoch);
    exact.x.push_back(state.position.x());
    exact.y.push_back(state.position.y());
    exact.angle.push_back(state.angle);
    exact.vx.push_back(state.velocity.x());
    exact.vy.push_back(state.velocity.y());
    exact.spin.push_back(state.spin);
  }
  return exact;
}

TEST(TakeOver, CorrectsTheCopyFromTheTickOfTheLastState) {
  for (const char* rule : {"retrospect", "rollback", "fade"}) {
    FollowedCopy pair(kFlying, rule, 2);
    pair.Steps(20);
    pair.talking = false;
    BodyState wrong = pair.copy_world().Read(0);
    wrong.position.x() += 0.4f;
    wrong.velocity.y() += 1;
    pair.PutCopy(0, wrong);
    pair.Steps(4);
    const ExactStates last = Exact(pair.truth, 2);
    pair.Steps(kLate);
    ASSERT_GT(pair.Apart(0).norm(), 0.3f) << rule;
    const BodyState off = pair.copy.TakeOver(last);
    EXPECT_NEAR(off.position.norm(), 0.41, 0.02) << rule;
    EXPECT_NEAR(off.velocity.norm(), 1, 0.02) << rule;
    EXPECT_LT(pair.Apart(0).norm(), 0.002f) << rule;
    const Vec2 speed = pair.copy_world().Read(0).velocity - pair.truth.Read(0).velocity;
    EXPECT_LT(speed.norm(), 0.01f) << rule;
    pair.Steps(20);
    EXPECT_LT(pair.Apart(0).norm(), 0.01f) << rule << ": it flies on as the other";
  }
}

TEST(TakeOver, DoesNotExtrapolateADifferenceFromBeforeTheReachOfReplays) {
  FollowedCopy pair(kFlying, "rollback", 2);
  pair.Steps(20);
  pair.talking = false;
  BodyState wrong = pair.copy_world().Read(0);
  wrong.velocity.x() += 4;
  pair.PutCopy(0, wrong);
  pair.Steps(4);
  const ExactStates last = Exact(pair.truth, 2);
  const int late = kReplayMax * 60 + 8;  // the past reaches back that far, the barriers do not
  pair.Steps(late);
  const Vec2 before = pair.copy_world().Read(0).position;
  const BodyState off = pair.copy.TakeOver(last);
  EXPECT_NEAR(off.velocity.norm(), 4, 0.02) << "the difference is reported";
  const Vec2 moved = pair.copy_world().Read(0).position - before;
  EXPECT_LT(moved.norm(), 0.01f) << "4 m/s for two seconds would be 8 m";
}

TEST(TakeOver, AnOlderStateChangesNothing) {
  FollowedCopy pair(kFlying, "retrospect", 2);
  pair.Steps(4);
  ExactStates old = Exact(pair.truth, 2);
  old.x[0] += 3;
  pair.Steps(20);
  const Vec2 before = pair.copy_world().Read(0).position;
  EXPECT_EQ(pair.copy.TakeOver(old).position.norm(), 0);
  EXPECT_EQ(pair.copy_world().Read(0).position, before);
}

TEST(TakeOver, AStateOfAPastEpochChangesNothing) {
  FollowedCopy pair(kFlying, "retrospect", 2);
  pair.Steps(10);
  ExactStates stale = Exact(pair.truth, 0);
  stale.x[0] += 3;
  const Vec2 before = pair.copy_world().Read(0).position;
  pair.copy.TakeOver(stale);
  EXPECT_EQ(pair.copy_world().Read(0).position, before);
}

}  // namespace take_over_test
}  // namespace seam
