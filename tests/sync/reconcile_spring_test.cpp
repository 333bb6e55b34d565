/// spring: the damped oscillator, its cap, and that it yields to obstacles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/sync/blend/reconcile.h"
#include "tests/support/followed_copy.h"

namespace seam {
namespace reconcile_spring_test {

const char* kWeightless = "gravity = [0, 0]\n[solver]\nsleep = false\n";

/// Input of the rule for a copy that is `apart` from a resting authority, with a free path.
PullInput Apart(const Vec2& apart, const Vec2& velocity = {0, 0}) {
  PullInput in;
  in.local.position = apart;
  in.local.velocity = velocity;
  in.step = 1.0f / 60;
  return in;
}

TEST(Spring, ConvergesAsTheDampedOscillatorDoes) {
  // Stiffness and damping as the rule has them, read off one tick of it.
  PullMemory memory;
  const double k = -60.0 * static_cast<double>(PullSpring(Apart({1, 0}), &memory).now.velocity.x());
  memory = {};
  const double c =
      -60.0 * static_cast<double>(PullSpring(Apart({0, 0}, {1, 0}), &memory).now.velocity.x());
  ASSERT_GT(k, 0);
  ASSERT_GT(c, 0);
  FollowedCopy f(std::string(kWeightless) + "[[part]]\nname = \"a\"\nbox = [1, 1]\n", "spring", 6);
  f.Steps(20);
  BodyState moved = f.copy.world().Read(0);
  moved.position.x() += 2;
  f.PutCopy(0, moved);
  // Per tick: v += (-k x - c v) h, x += v h. That map, iterated in double, is the exact answer...
  double x = 2, v = 0;
  const double h = 1.0 / 60;
  // ...and the oscillator's closed form is near it.
  const double root = std::sqrt(std::max(0.0, c * c / 4 - k));
  const double wave = std::sqrt(std::max(0.0, k - c * c / 4));
  for (int t = 1; t <= 120; ++t) {
    f.Step();
    v += (-k * x - c * v) * h;
    x += v * h;
    const double s = t * h;
    const double decay = std::exp(-c * s / 2);
    const double closed =
        root > 1e-3   ? 2 * decay * (std::cosh(root * s) + c / 2 / root * std::sinh(root * s))
        : wave > 1e-3 ? 2 * decay * (std::cos(wave * s) + c / 2 / wave * std::sin(wave * s))
                      : 2 * decay * (1 + c / 2 * s);
    ASSERT_NEAR(f.Apart(0).x(), x, 4e-3) << "tick " << t;
    ASSERT_NEAR(f.Apart(0).x(), closed, 0.06 * 2) << "tick " << t;
  }
  EXPECT_LT(std::fabs(x), 0.01) << "after 2 s it is nearly there";
}

TEST(Spring, DemandsNoMoreThanItsCap) {
  for (const float apart : {0.1f, 1.0f, 7.0f, 1000.0f}) {
    PullMemory memory;
    PullInput in = Apart({0.6f * apart, -0.8f * apart}, {-3 * apart, 4 * apart});
    in.target.angle = apart;
    in.target.spin = 14;
    const Correction c = PullSpring(in, &memory);
    EXPECT_LE(c.now.velocity.norm() * 60, 100.01f) << apart;
    EXPECT_LE(std::fabs(c.now.spin) * 60, 100.01f) << apart;
    EXPECT_EQ(c.now.position.norm(), 0) << "velocity only";
  }
}

TEST(Spring, PlacesOnlyDistantCopies) {
  ReconcileInput in;
  in.remote.velocity = Vec2(10, 0);
  in.dt = 0.1f;
  in.remote.position = Vec2(6, 0);  // moved on: 7
  EXPECT_EQ(ReconcileSpring(in).now.position.norm(), 0);
  in.remote.position = Vec2(8, 0);
  EXPECT_FLOAT_EQ(ReconcileSpring(in).now.position.x(), 9);
  in.dt = 2;  // moved on by 0.3 s, no more
  EXPECT_FLOAT_EQ(ReconcileSpring(in).now.position.x(), 11);
}

/// Against permanent obstacles a correction takes the authority's side (Corrector::WayTo): this
/// wall could move, a little.
const char* kWall =
    "[[part]]\nname = \"wall\"\nbox = [0.1, 10]\nposition = [2, 0]\nanchored = true\n"
    "[[part]]\nname = \"a\"\nbox = [1, 1]\n"
    "[[joint]]\nname = \"moves\"\nkind = \"kinematic\"\nb = \"wall\"\n"
    "path = [[0, 0], [0, 0.1]]\nperiod = 600\n";

TEST(Spring, YieldsIfAWallBlocksTheCopy) {
  // The authority's body is beyond the wall; the copy can never get there.
  FollowedCopy f(std::string(kWeightless) + kWall, "spring", 6);
  f.Steps(10);
  BodyState beyond = f.truth.Read(0);
  beyond.position.x() = 5;
  f.truth.Write(0, beyond);
  f.Steps(120);  // it has come to the wall
  float first = 0, last = 0, farthest = 0;
  for (int t = 0; t < 600; ++t) {
    f.Step();
    const BodyState s = f.copy.world().Read(0);
    float& most = t < 120 ? first : last;
    if (t < 120 || t >= 480) most = std::max(most, s.velocity.norm());
    farthest = std::max(farthest, s.position.x());
  }
  EXPECT_LT(farthest, 1.5f) << "the wall's face is at 1.95, the copy's half width 0.5";
  EXPECT_LT(last, 0.1f) << "it does not hammer";
  EXPECT_LE(last, first + 0.01f) << "nor ever harder";
}

TEST(Spring, ReturnsToFullStrengthWhenThePathIsFree) {
  PullMemory memory;
  PullInput in = Apart({-1, 0});
  const float full = PullSpring(in, &memory).now.velocity.x();
  memory.before = in.local.velocity;
  memory.asked = Vec2(full, 0);
  EXPECT_EQ(PullSpring(in, &memory).now.velocity.x(), 0) << "it did not move as asked";
  memory.asked.setZero();
  float asked = 0, before = -1;
  for (int t = 0; t < 60; ++t) {
    asked = PullSpring(in, &memory).now.velocity.x();
    EXPECT_GE(asked, before);
    before = asked;
    memory.before = in.local.velocity;  // and now it moves
    memory.asked = Vec2(asked, 0);
    in.local.velocity.x() = 0;
    memory.before.x() = -asked;
  }
  EXPECT_FLOAT_EQ(asked, full);
}

TEST(Spring, StandingOnTheGroundIsNoBlock) {
  // Beside the resting body of its authority, on the ground: the contact takes gravity, not the
  // pull.
  FollowedCopy f(
      "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
      "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 0.5]\nfriction = 0\n"
      "velocity = [1, 0]\n",
      "spring", 6);
  f.Steps(20);
  BodyState moved = f.copy.world().Read(0);
  moved.position.x() += 1;
  f.PutCopy(0, moved);
  f.Steps(240);
  EXPECT_NEAR(f.Apart(0).x(), 0, 0.05);
}

}  // namespace reconcile_spring_test
}  // namespace seam
