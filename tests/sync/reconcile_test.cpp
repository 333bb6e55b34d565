/// Reconcilers on cases small enough to do by hand.

#include "common/sync/blend/reconcile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/check.h"

namespace seam {
namespace reconcile_test {

BodyState At(float x, float vx = 0) {
  BodyState s;
  s.position = Vec2(x, 0);
  s.velocity = Vec2(vx, 0);
  return s;
}

float CorrectedX(const ReconcileInput& in, Reconciler rule) {
  return (in.local.position + rule(in).now.position).x();
}

TEST(Reconcile, SnapTakesTheRemoteStateAsItIs) {
  ReconcileInput in;
  in.local = At(10, 5);
  in.remote = At(7, 4);
  in.dt = 0.1f;
  const Correction c = ReconcileSnap(in);
  EXPECT_FLOAT_EQ((in.local.position + c.now.position).x(), 7);
  EXPECT_FLOAT_EQ((in.local.velocity + c.now.velocity).x(), 4);
}

TEST(Reconcile, InterleaveMeetsHalfWay) {
  ReconcileInput in;
  in.local = At(10, 5);
  in.remote = At(7, 4);
  EXPECT_FLOAT_EQ(CorrectedX(in, ReconcileInterleave), 8.5f);
}

TEST(Reconcile, CompensatedMeetsHalfWayToTheExtrapolatedState) {
  ReconcileInput in;
  in.local = At(10);
  in.remote = At(7, 20);
  in.dt = 0.1f;  // moved on to 9
  EXPECT_FLOAT_EQ(CorrectedX(in, ReconcileCompensated), 9.5f);
}

TEST(Reconcile, CompensatedLeavesUniformMotionAlone) {
  ReconcileInput in;
  in.local = At(9, 20);
  in.remote = At(7, 20);
  in.dt = 0.1f;
  EXPECT_NEAR(ReconcileCompensated(in).now.position.norm(), 0, 1e-6);
}

TEST(Reconcile, FadeKeepsTheLocalResultRightAfterAnImpact) {
  ReconcileInput in;
  in.local = At(10, -3);
  in.remote = At(7, 30);
  in.dt = 0.1f;
  in.since_impact = 0;
  EXPECT_FLOAT_EQ(CorrectedX(in, ReconcileFade), 10);
  in.since_impact = 0.25f;  // a quarter of the way to 7 + 30 * 0.1 = 10 ... velocity too
  const Correction c = ReconcileFade(in);
  EXPECT_NEAR((in.local.velocity + c.now.velocity).x(), -3, 1e-6) << "10 and 10: left alone";
  in.remote = At(9, 30);  // moved on to 12
  const Correction d = ReconcileFade(in);
  EXPECT_FLOAT_EQ((in.local.position + d.now.position).x(), 10.5f);
  EXPECT_FLOAT_EQ((in.local.velocity + d.now.velocity).x(), -3 + 33 * 0.25f);
}

TEST(Reconcile, FadeTakesTheExtrapolatedStateASecondAfterTheImpact) {
  ReconcileInput in;
  in.local = At(10);
  in.remote = At(7, 20);
  in.dt = 0.1f;
  in.since_impact = 1.5f;
  EXPECT_FLOAT_EQ(CorrectedX(in, ReconcileFade), 9);
}

TEST(Reconcile, RetrospectIsExactUnderGravityAndCompensatedIsNot) {
  // Two copies of a thrown body, the local one displaced by 0.3 m and 0.5 m/s since before t1.
  const float g = -10;
  const float dt = 0.2f;
  auto flight = [&](float x0, float v0, float t) {
    BodyState s;
    s.position = Vec2(x0 + v0 * t, 8 * t + 0.5f * g * t * t);
    s.velocity = Vec2(v0, 8 + g * t);
    return s;
  };
  const float t1 = 0.4f;
  const BodyState truth_now = flight(0, 5, t1 + dt);
  const BodyState local_then = flight(0.3f, 5.5f, t1);
  ReconcileInput in;
  in.local = flight(0.3f, 5.5f, t1 + dt);
  in.remote = flight(0, 5, t1);
  in.local_then = &local_then;
  in.dt = dt;
  in.common = Minus(in.remote, local_then);
  const Correction exact = ReconcileRetrospect(in);
  EXPECT_NEAR((in.local.position + exact.now.position - truth_now.position).norm(), 0, 1e-5);
  EXPECT_NEAR((in.local.velocity + exact.now.velocity - truth_now.velocity).norm(), 0, 1e-5);
  const Correction half = ReconcileCompensated(in);
  EXPECT_GT((in.local.position + half.now.position - truth_now.position).norm(), 0.1);
}

TEST(Reconcile, RetrospectTakesABoundedShareOfACoupledBody) {
  const BodyState then = At(0, 0);
  ReconcileInput in;
  in.local = At(0);
  in.local_then = &then;
  in.remote = At(0.1f, 1);
  in.dt = 0.1f;
  in.coupled = true;
  in.gain = 0.25f;
  const Correction c = ReconcileRetrospect(in);
  EXPECT_FLOAT_EQ(c.now.position.x(), 0.025f) << "no Dv dt term";
  EXPECT_FLOAT_EQ(c.now.velocity.x(), 0.25f);
}

TEST(Reconcile, RetrospectDoesNotExtrapolateIntoTheGround) {
  BodyState then;
  ReconcileInput in;
  in.local_then = &then;
  in.remote.position = Vec2(0.2f, 0.1f);
  in.remote.velocity = Vec2(2, 1);
  in.common = in.remote;
  in.dt = 0.1f;
  in.gain = 0.25f;
  in.blocked_count = 1;
  in.blocked_directions[0] = Vec2(0, 1);
  const Correction c = ReconcileRetrospect(in);
  EXPECT_FLOAT_EQ(c.now.position.x(), 0.2f + 2 * 0.1f) << "along the ground: all of it, carried on";
  EXPECT_FLOAT_EQ(c.now.position.y(), 0.025f) << "across: a bounded share";
  EXPECT_FLOAT_EQ(c.now.velocity.x(), 2);
  EXPECT_FLOAT_EQ(c.now.velocity.y(), 0.25f);
}

TEST(Reconcile, RetrospectExtrapolatesAMechanismAsAWhole) {
  // A wheel that swings on its spring: the car's own difference is carried on, the swing is not.
  BodyState then;
  ReconcileInput in;
  in.local_then = &then;
  in.remote.position = Vec2(1, 0.08f);
  in.remote.velocity = Vec2(0, -8);
  in.common.position = Vec2(1, 0);
  in.common.velocity = Vec2(2, 0);
  in.alone = false;
  in.dt = 0.1f;
  in.gain = 0.5f;
  const Correction c = ReconcileRetrospect(in);
  EXPECT_FLOAT_EQ(c.now.position.x(), 1 + 0.2f);
  EXPECT_FLOAT_EQ(c.now.position.y(), 0.04f);
}

TEST(Reconcile, RetrospectMovesACoupledBodyByFiveCentimetresAtMost) {
  const BodyState then = At(0);
  ReconcileInput in;
  in.local_then = &then;
  in.remote = At(3);
  in.coupled = true;
  in.gain = 0.5f;
  EXPECT_FLOAT_EQ(ReconcileRetrospect(in).now.position.x(), 0.05f);
}

TEST(Reconcile, RetrospectWaitsForAPastUnlessTheCopyIsFarOff) {
  ReconcileInput in;
  in.remote = At(0.2f, 2);
  EXPECT_EQ(ReconcileRetrospect(in).now.position.x(), 0);
  in.remote = At(0.3f, 2);
  EXPECT_FLOAT_EQ(ReconcileRetrospect(in).now.position.x(), 0.3f);
  in.remote = At(0.2f, 3);
  EXPECT_FLOAT_EQ(ReconcileRetrospect(in).now.velocity.x(), 3);
}

TEST(Reconcile, RetrospectLeavesQuantisationNoiseOfACoupledBodyAlone) {
  const BodyState then = At(0);
  ReconcileInput in;
  in.local = At(0);
  in.local_then = &then;
  in.remote = At(1.4f / 512, 1.4f / 256);
  in.coupled = true;
  in.gain = 1;
  const Correction c = ReconcileRetrospect(in);
  EXPECT_EQ(c.now.position.x(), 0);
  EXPECT_EQ(c.now.velocity.x(), 0);
}

TEST(Reconcile, EveryRuleLeavesEqualStatesAlone) {
  const BodyState same = At(3);
  for (const NamedReconciler& r : Reconcilers()) {
    ReconcileInput in;
    in.local = in.remote = same;
    in.local_then = &same;
    in.dt = 0.2f;
    EXPECT_EQ(r.rule(in).now.position.norm(), 0) << r.name;
    EXPECT_EQ(FindReconciler(r.name).rule, r.rule);
  }
  EXPECT_THROW(FindReconciler("magic"), OperatorError);
}

}  // namespace reconcile_test
}  // namespace seam
