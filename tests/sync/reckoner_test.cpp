/// Mechanisms are dead-reckoned, and their visual offsets return, as rigid wholes.

#include "common/sync/show/reckoner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "common/base/geometry.h"
#include "common/measure/joint_drift.h"
#include "common/sync/mode.h"
#include "common/sync/smoother.h"
#include "tests/support/own_table.h"
#include "tests/support/small_world.h"

namespace seam {
namespace reckoner_test {

/// Two rods on a hinge; `wheel` on the first.
const char* kRods = R"(gravity = [0, 0]
[[part]]
name = "left"
box = [2, 0.2]
position = [-1, 0]
[[part]]
name = "right"
box = [2, 0.2]
position = [1, 0]
[[part]]
name = "wheel"
circle = 0.3
position = [-1.5, 0]
[[joint]]
name = "hinge"
kind = "revolute"
a = "left"
b = "right"
anchor = [0, 0]
[[joint]]
name = "axle"
kind = "wheel"
a = "left"
b = "wheel"
axis = [0, 1]
anchor = [-1.5, 0]
[solver]
sleep = false
)";

Vec2 CentreOf(const World& world) {
  Vec2 sum(0, 0);
  float mass = 0;
  for (int body = 0; body < world.body_count(); ++body) {
    sum += world.mass(body) * world.Read(body).position;
    mass += world.mass(body);
  }
  return sum / mass;
}

/// Everything turns about the centre of mass at `spin` and moves by `velocity`; the wheel spins
/// at 20.
std::vector<BodyState> Turning(const World& world, float spin, const Vec2& velocity) {
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) {
    BodyState s = world.Read(body);
    const Vec2 arm = s.position - CentreOf(world);
    s.velocity = velocity + spin * Vec2(-arm.y(), arm.x());
    s.spin = body == 2 ? 20 : spin;
    states.push_back(s);
  }
  return states;
}

TEST(Reckoner, AMechanismMovesRigidlyAndItsWheelKeepsTurning) {
  World world(ParseScene(kRods, "test.toml"));
  ASSERT_EQ(world.body_count(), 3);
  OwnTable<Snapshots> snapshots(3);
  const std::vector<BodyState> states = Turning(world, 3, Vec2(5, -1));
  for (int body = 0; body < 3; ++body) {
    snapshots.Add(body, 0, states[static_cast<std::size_t>(body)]);
  }
  const JointCloser joints(world);
  Reckoner reckoner(world, snapshots, joints);
  reckoner.Begin(24);
  const float t = 0.4f;  // s: turned by 1.2 rad
  std::vector<BodyState> there;
  for (int body = 0; body < 3; ++body) there.push_back(reckoner.There(body));
  for (int body = 0; body < 3; ++body) {
    const BodyState& start = states[static_cast<std::size_t>(body)];
    const Vec2 centre = CentreOf(world);
    const Vec2 expected = centre + t * Vec2(5, -1) + Turned(Vec2(start.position - centre), 3 * t);
    EXPECT_LT((there[static_cast<std::size_t>(body)].position - expected).norm(), 1e-3f) << body;
  }
  EXPECT_NEAR(there[0].angle, 3 * t, 1e-3);
  EXPECT_NEAR(there[2].angle, 20 * t, 1e-3);
  const JointMeter meter(world.scene(), world.composition());
  EXPECT_LT(meter.Worst(there), 1e-3);
  // One by one they would come apart.
  std::vector<BodyState> apart;
  for (int body = 0; body < 3; ++body) {
    apart.push_back(snapshots.Extrapolate(body, 24, world.dt(), kReckonMax));
  }
  EXPECT_GT(meter.Worst(apart), 0.3);
}

/// Two parts with a spring of 5 Hz between them: pose of "b" in a's frame, when both are
/// dead-reckoned by `ticks` after states of b with this motion and of a with none.
BodyState SwungAfter(const std::string& joint, std::int64_t ticks, const BodyState& moves) {
  World world(ParseScene(
      "gravity = [0, 0]\n[[part]]\nname = \"a\"\nbox = [3, 1]\nposition = [0, 2]\n"
      "[[part]]\nname = \"b\"\nbox = [0.5, 0.5]\nposition = [1, 1]\n[[joint]]\nname = \"spring\"\n"
      "a = \"a\"\nb = \"b\"\nfrequency = 5\n" +
          joint,
      "sprung.toml"));
  OwnTable<Snapshots> snapshots(2);
  BodyState b = world.Read(1);
  b.velocity = moves.velocity;
  b.spin = moves.spin;
  snapshots.Add(0, 0, world.Read(0));
  snapshots.Add(1, 0, b);
  const JointCloser joints(world);
  Reckoner reckoner(world, snapshots, joints);
  reckoner.Begin(ticks);
  const BodyState at = reckoner.There(0), of = reckoner.There(1);
  BodyState out;
  out.position = Turned(Vec2(of.position - at.position), -at.angle);
  out.angle = of.angle - at.angle;
  return out;
}

TEST(Reckoner, ASpringedBodySwingsAndTravelsNoFurther) {
  const float swing = 2 * kPiFloat * 5;
  for (const std::int64_t ticks : {1, 30, 119}) {
    BodyState moves;
    moves.velocity = Vec2(0, -6);
    const BodyState wheel =
        SwungAfter("kind = \"wheel\"\naxis = [0, 1]\nanchor = [1, 1]\n", ticks, moves);
    EXPECT_LE(std::fabs(wheel.position.y() + 1), 6 / swing + 0.01f) << "after " << ticks;
    EXPECT_NEAR(wheel.position.x(), 1, 0.01) << "after " << ticks;
    const BodyState tied =
        SwungAfter("kind = \"distance\"\nanchor_a = [1, 2]\nanchor_b = [1, 1]\n", ticks, moves);
    EXPECT_LE(std::fabs((tied.position - Vec2(1, 0)).norm() - 1), 6 / swing + 0.05f)
        << "after " << ticks;
    moves.velocity.setZero();
    moves.spin = 10;
    const BodyState bent = SwungAfter("kind = \"weld\"\nanchor = [1, 1]\n", ticks, moves);
    EXPECT_LE(std::fabs(WrapAngle(bent.angle)), 10 / swing + 0.01f) << "after " << ticks;
  }
  BodyState moves;
  moves.velocity = Vec2(0, -6);
  const BodyState slides =
      SwungAfter("kind = \"wheel\"\naxis = [0, 1]\nanchor = [1, 1]\n", 1, moves);
  EXPECT_NEAR(slides.position.y(), -1.1, 0.02) << "within that it moves as it did";
}

TEST(Reckoner, StatesOfDifferentTicksDoNotOpenItsJoints) {
  World world(ParseScene(kRods, "test.toml"));
  OwnTable<Snapshots> snapshots(3);
  const std::vector<BodyState> states = Turning(world, 1, Vec2(0, 0));
  snapshots.Add(0, 6, states[0]);
  snapshots.Add(1, 0, states[1]);
  snapshots.Add(2, 3, states[2]);
  const JointCloser joints(world);
  Reckoner reckoner(world, snapshots, joints);
  reckoner.Begin(20);
  std::vector<BodyState> here;
  for (int body = 0; body < 3; ++body) here.push_back(reckoner.Here(body));
  EXPECT_LT(JointMeter(world.scene(), world.composition()).Worst(here), 1e-3);
}

/// Three rods in a row whose ends are at a fixed distance: they fit in two ways.
const char* kFourBar = R"(gravity = [0, 0]
[[part]]
name = "left"
box = [0.2, 2]
position = [-1, 1]
[[part]]
name = "top"
box = [2, 0.2]
position = [0, 2]
[[part]]
name = "right"
box = [0.2, 2]
position = [1, 1]
[[joint]]
name = "a"
kind = "revolute"
a = "left"
b = "top"
anchor = [-1, 2]
limits = [-1, 1]
[[joint]]
name = "b"
kind = "revolute"
a = "top"
b = "right"
anchor = [1, 2]
limits = [-1, 1]
[[joint]]
name = "c"
kind = "distance"
a = "left"
b = "right"
anchor_a = [-1, 0]
anchor_b = [1, 0]
[solver]
sleep = false
)";

/// Received states of a mechanism may have joints open by a metre, as at its holder. Closing them
/// finds another pose at each tick, and none of that is a motion: it would hit its neighbours at
/// 100 m/s.
TEST(Reckoner, ClosingOpenJointsAddsNoMotion) {
  World world(ParseScene(kFourBar, "test.toml"));
  std::mt19937 random(1);
  std::uniform_real_distribution<float> off(-1.5f, 1.5f);
  const JointCloser joints(world);
  float fastest = 0, jumped = 0;
  for (int draw = 0; draw < 400; ++draw) {
    OwnTable<Snapshots> snapshots(3);
    for (int body = 0; body < 3; ++body) {
      BodyState s = world.Read(body);
      s.position += Vec2(off(random), off(random));
      s.angle += 2 * off(random);
      s.velocity = Vec2(5 + off(random), off(random));
      s.spin = off(random);
      snapshots.Add(body, 0, s);
    }
    Reckoner reckoner(world, snapshots, joints);
    for (int next = 2; next < 30; ++next) {
      reckoner.Begin(next);
      for (int body = 0; body < 3; ++body) {
        const Vec2 way = reckoner.There(body).position - reckoner.Here(body).position;
        jumped = std::max(jumped, (way / world.dt() - Vec2(5, 0)).norm());
        fastest = std::max(fastest, (reckoner.Speed(body).velocity - Vec2(5, 0)).norm());
      }
    }
  }
  EXPECT_GT(jumped, 40) << "nothing was closed in two ways";
  EXPECT_LT(fastest, 20);
}

/// A ball and a crate that are heard of while they fall, and no more: both hit the floor, the ball
/// a wall, too.
const char* kThrown = R"([[part]]
name = "floor"
box = [40, 2]
position = [0, -1]
anchored = true
[[part]]
name = "wall"
box = [1, 40]
position = [6, 20]
anchored = true
[[part]]
name = "ball"
circle = 0.4
position = [4, 3]
velocity = [5, 0]
restitution = 0.8
friction = 0.2
[[part]]
name = "crate"
box = [1, 1]
position = [-5, 4]
velocity = [-1, 1]
spin = 1
)";

TEST(Reckoner, AFreelyFallingBodyBouncesOffAnchoredOnes) {
  World world(ParseScene(kThrown, "test.toml"));
  const JointCloser joints(world);
  OwnTable<Snapshots> falling(2), straight(2);
  for (int body = 0; body < 2; ++body) {
    falling.Add(body, 0, world.Read(body), true);
    straight.Add(body, 0, world.Read(body));
  }
  Reckoner reckoner(world, falling, joints), straight_on(world, straight, joints);
  float off = 0, lowest = 9, rightmost = -9, straight_off = 0;
  for (int tick = 1; tick <= 90; ++tick) {
    world.Step();
    reckoner.Begin(tick + 1);
    straight_on.Begin(tick + 1);
    for (int body = 0; body < 2; ++body) {
      const Vec2 at = reckoner.Here(body).position, is = world.Read(body).position;
      if (body == 0) off = std::max(off, (at - is).norm());
      if (body == 0) rightmost = std::max(rightmost, at.x());
      lowest = std::min(lowest, at.y());
      straight_off = std::max(straight_off, (straight_on.Here(body).position - is).norm());
    }
  }
  EXPECT_GT(straight_off, 5) << "nothing fell or bounced";
  EXPECT_LT(off, 0.25f) << "over two bounces, m";
  EXPECT_GT(lowest, 0.3f);
  EXPECT_LT(rightmost, 5.15f);
}

/// An absent body is updated every few ticks and moves straight between: to its pose at the next
/// update.
TEST(Reckoner, AnAbsentBodyMovesStraightToItsFallByTheNextUpdate) {
  World world(ParseScene(kThrown, "test.toml"));
  World truth(ParseScene(kThrown, "test.toml"));
  world.SetActivity(0, Activity::kDisplayed);
  const JointCloser joints(world);
  OwnTable<Snapshots> snapshots(2);
  snapshots.Add(0, 0, world.Read(0), true);
  Reckoner reckoner(world, snapshots, joints);
  for (int tick = 0; tick <= 24; tick += kShownEvery) {
    reckoner.Begin(tick + 1);
    EXPECT_LT((reckoner.Here(0).position - truth.Read(0).position).norm(), 0.02f) << tick;
    const Vec2 next =
        reckoner.Here(0).position + kShownEvery * world.dt() * reckoner.Speed(0).velocity;
    for (int more = 0; more < kShownEvery; ++more) truth.Step();
    EXPECT_LT((next - truth.Read(0).position).norm(), 0.02f) << tick;
  }
}

TEST(Smoother, ARigidJumpOfAMechanismReturnsRigidly) {
  World world(ParseScene(kRods, "test.toml"));
  OwnTable<Smoother> smoother(3, kSmoothRate);
  for (int body = 0; body < 3; ++body) {
    // Offset of physics from the view: turned by 1 rad about a point, and moved.
    const BodyState s = world.Read(body);
    BodyState by;
    by.angle = 1;
    by.position = s.position - Turned(Vec2(s.position - Vec2(1, 1)), -1.0f) - Vec2(2, 1);
    smoother.Moved(body, by);
  }
  const JointMeter meter(world.scene(), world.composition());
  const float far = smoother.offset(0).norm();
  for (int frame = 0; frame < 120; ++frame) {
    std::vector<BodyState> shown;
    for (int body = 0; body < 3; ++body) {
      BodyState s = world.Read(body);
      s.position += smoother.offset(body);
      s.angle += smoother.angle_offset(body);
      shown.push_back(s);
    }
    ASSERT_LT(meter.Worst(shown), 1e-4) << frame;
    smoother.AdvanceTogether(world, {0, 1, 2}, [&](int body) { return world.Read(body); });
  }
  EXPECT_GT(far, 1);
  EXPECT_LT(smoother.offset(0).norm(), 0.01f);
}

}  // namespace reckoner_test
}  // namespace seam
