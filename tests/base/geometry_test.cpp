/// Angles, rotations and rigid motions of the plane.

#include "common/base/geometry.h"

#include <gtest/gtest.h>

#include <limits>

namespace seam {
namespace geometry_test {

using Eigen::Vector2d;
using Eigen::Vector2f;

void ExpectNear(const Vector2d& a, const Vector2d& b, double bound) {
  EXPECT_LE((a - b).norm(), bound) << a.transpose() << " instead of " << b.transpose();
}

TEST(Geometry, AnAngleWithinHalfATurnStaysAsItIs) {
  for (const double angle : {-3.141, -1.0, -0.0, 0.0, 1e-300, 1.0, 3.141, kPi, -kPi}) {
    EXPECT_EQ(WrapAngle(angle), angle);
  }
  for (const float angle : {-3.141f, 0.0f, 3.141f, kPiFloat, -kPiFloat}) {
    EXPECT_EQ(WrapAngle(angle), angle);
  }
}

TEST(Geometry, JustBeyondHalfATurnIsJustBeforeItOnTheOtherSide) {
  const double beyond = std::nextafter(kPi, 4.0);
  EXPECT_EQ(WrapAngle(beyond), beyond - 2 * kPi);
  EXPECT_EQ(WrapAngle(-beyond), 2 * kPi - beyond);
  const float beyond_float = std::nextafter(kPiFloat, 4.0f);
  EXPECT_EQ(WrapAngle(beyond_float), beyond_float - 2 * kPiFloat);
  EXPECT_EQ(WrapAngle(-beyond_float), 2 * kPiFloat - beyond_float);
  // One and a half turns: either side is right.
  EXPECT_EQ(std::fabs(WrapAngle(3 * kPi)), 3 * kPi - 2 * kPi);
}

TEST(Geometry, LargeAnglesLoseWholeTurnsExactly) {
  for (const int turns : {1, -1, 7, 1 << 20, -(1 << 30)}) {
    EXPECT_EQ(WrapAngle(2 * kPi * turns), 0) << turns;
    EXPECT_NEAR(WrapAngle(2 * kPi * turns + 0.5), 0.5, 1e-6) << turns;
    EXPECT_EQ(WrapAngle(2 * kPiFloat * static_cast<float>(1 << 20)), 0);
  }
  EXPECT_LE(std::fabs(WrapAngle(1e300)), kPi);
  EXPECT_LE(std::fabs(WrapAngle(-3e38f)), kPiFloat);
  EXPECT_TRUE(std::isnan(WrapAngle(std::numeric_limits<double>::infinity())));
}

TEST(Geometry, UnwrappingChoosesTheTurnNearestToTheReference) {
  EXPECT_NEAR(UnwrapAngle(-3.0, 3.0), 2 * kPi - 3, 1e-15);
  EXPECT_NEAR(UnwrapAngle(3.0, -3.0), 3 - 2 * kPi, 1e-15);
  EXPECT_NEAR(UnwrapAngle(0.25, 20 * kPi), 20 * kPi + 0.25, 1e-13);
  EXPECT_NEAR(UnwrapAngle(20 * kPi + 0.25, 0.0), 0.25, 1e-13);
  EXPECT_NEAR(UnwrapAngle(-3.0f, 3.0f), 2 * kPiFloat - 3, 1e-6f);
  for (double near = -50; near < 50; near += 0.37) {
    const double angle = UnwrapAngle(1.0, near);
    EXPECT_LE(std::fabs(angle - near), kPi + 1e-12) << near;
    EXPECT_NEAR(WrapAngle(angle), 1.0, 1e-12) << near;
  }
}

TEST(Geometry, AQuarterTurnIsCounterClockwise) {
  ExpectNear(Turned(Vector2d(2, 0), kPi / 2), {0, 2}, 1e-15);
  ExpectNear(Turned(Vector2d(0, 2), kPi / 2), {-2, 0}, 1e-15);
  ExpectNear(Turned(Vector2f(2, 1), kPiFloat / 2).cast<double>(), {-1, 2}, 1e-6);
  ExpectNear(Rotation<double>(kPi / 2).Back({0, 2}), {2, 0}, 1e-15);
  EXPECT_EQ(Cross(Vector2d(2, 0), Vector2d(1, 3)), 6);
  EXPECT_EQ(Cross(Vector2f(1, 3), Vector2f(2, 0)), -6);
}

TEST(Geometry, TurningBackIsTurningByTheNegativeAngle) {
  for (double angle = -7; angle < 7; angle += 0.3) {
    const Vector2d v(1.5, -0.25);
    EXPECT_EQ(Rotation<double>(angle).Back(v), Turned(v, -angle)) << angle;
    ExpectNear(Rotation<double>(angle).Back(Turned(v, angle)), v, 1e-15);
  }
}

TEST(Geometry, ARigidMotionTurnsFirstAndMovesThen) {
  const Transform2 motion{{10, 0}, kPi / 2};
  ExpectNear(motion({1, 0}), {10, 1}, 1e-15);
  ExpectNear(motion.Turned({1, 0}), {0, 1}, 1e-15);
}

TEST(Geometry, TheInverseUndoesAMotionFromEitherSide) {
  const Transform2 motion{{-3, 8}, 2.5};
  const Vector2d p(0.5, -4);
  ExpectNear(motion.Inverse()(motion(p)), p, 1e-14);
  ExpectNear(motion(motion.Inverse()(p)), p, 1e-14);
  for (const Transform2& none : {motion.Then(motion.Inverse()), motion.Inverse().Then(motion)}) {
    ExpectNear(none.shift, {0, 0}, 1e-14);
    EXPECT_EQ(none.angle, 0);
  }
}

TEST(Geometry, ThenAppliesTheInnerMotionFirst) {
  const Transform2 outer{{1, 2}, 0.7}, inner{{-4, 0.5}, -1.9};
  const Vector2d p(3, -2);
  ExpectNear(outer.Then(inner)(p), outer(inner(p)), 1e-14);
  EXPECT_GT((outer.Then(inner)(p) - inner(outer(p))).norm(), 0.1) << "the order counts";
}

}  // namespace geometry_test
}  // namespace seam
