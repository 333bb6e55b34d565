/// Taking a seat: the character arrives in one piece and in time, and disturbs nobody.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/stages/make_stages.h"
#include "tests/support/small_world.h"

namespace seam {
namespace seat_test {

constexpr const char* kVehicle = R"(
[[part]]
name = "buggy"
box = [2.4, 0.35]
position = [3, 0.75]
[[part]]
name = "wheel"
circle = 0.4
position = [2.2, 0.42]
friction = 0.95
repeat = {count = 2, step = [1.6, 0]}
[[joint]]
name = "axle"
kind = "wheel"
a = "buggy"
b = "wheel.0"
frequency = 5
repeat = {count = 2, step = [1.6, 0]}
[[seat]]
name = "driver"
part = "buggy"
at = [0, 0.7]
reach = 9
button = 5
)";

/// A character on a floor, and something to sit in 3 m from it.
std::unique_ptr<World> WithCharacter() {
  auto world = SmallWorld(std::string(R"(
[[player]]
name = "ann"
vehicle = "hero.torso"
[[part]]
name = "floor"
chain = [[-90, 0], [90, 0]]
friction = 0.9
[[character]]
name = "hero"
player = "ann"
position = [0, 0]
)") + kVehicle,
                          "substeps = 4\n");
  Steps(world.get(), 30);
  return world;
}

PartId Named(const World& world, const std::string& name) {
  for (const Part& part : world.scene().parts) {
    if (part.name == name) return part.id;
  }
  return -1;
}

void Take(World* world) { world->Apply({Edit(SeatEdit{0, 0}, EditCause::kOutside)}); }

void BondToSeat(World* world) {
  const Seat seat = world->scene().seats[0];
  const PartId own = world->scene().players[0].vehicle;
  world->Apply({Edit(BondEdit{seat.part, own, seat.at, seat.angle}, EditCause::kOutside)});
}

/// Distance of the torso from its place in the seat, m.
float ToSeat(const World& world) {
  const Seat& seat = world.scene().seats[0];
  const BodyState there = PartPose(world, seat.part);
  const Vec2 place = there.position + Turned(seat.at, there.angle);
  return (PartPose(world, world.scene().players[0].vehicle).position - place).norm();
}

/// The worst joint of the character, m.
double Torn(const World& world) {
  const auto is_limb = [&](const Joint& joint) { return joint.name.rfind("hero.", 0) == 0; };
  double worst = 0;
  for (const Joint& joint : world.scene().joints) {
    if (joint.gone || !is_limb(joint)) continue;
    const auto end = [&](PartId id, const Vec2& anchor) {
      const Part& part = world.scene().parts[static_cast<std::size_t>(id)];
      const BodyState pose = PartPose(world, id);
      const Vec2 local = Turned(Vec2(anchor - part.position), -part.angle);
      return Vec2(pose.position + Turned(local, pose.angle));
    };
    const Vec2 gap = end(joint.a, joint.anchor_a) - end(joint.b, joint.anchor_b);
    worst = std::max(worst, static_cast<double>(gap.norm()));
  }
  return worst;
}

/// 3 % of the shortest limb of a hand's length: nobody sees it.
constexpr double kClosed = 0.03 * 0.44;

TEST(Seat, ACharacterReachesItWithAllLimbsInTheStatedTime) {
  const auto world = WithCharacter();
  const PartId torso = Named(*world, "hero.torso");
  ASSERT_GT(ToSeat(*world), 2.5f);
  Take(world.get());
  for (int tick = 1; tick <= SeatTicks(60); ++tick) {
    const Vec2 before = PartPose(*world, torso).position;
    world->Step();
    const BodyState now = PartPose(*world, torso);
    const float step = (now.position - before).norm();
    EXPECT_LT(step, now.velocity.norm() / 60 + 0.1f) << "no jump, tick " << tick;
    EXPECT_LT(Torn(*world), kClosed) << "tick " << tick;
    if (tick == SeatWaitTicks(60)) {
      EXPECT_GT(ToSeat(*world), 2.5f) << "it waits at first";
    }
  }
  EXPECT_LT(ToSeat(*world), 0.02f);
  const Vec2 before = PartPose(*world, torso).position;
  BondToSeat(world.get());
  EXPECT_LT((PartPose(*world, torso).position - before).norm(), 0.02f);
  for (int tick = 0; tick < 60; ++tick) {
    EXPECT_LT(Torn(*world), kClosed) << tick << " ticks after the bond";
    world->Step();
  }
}

TEST(Seat, ASittingCharacterIsHeldUntilTheBondComes) {
  const auto world = WithCharacter();
  Take(world.get());
  Steps(world.get(), SeatTicks(60) + 20);
  EXPECT_LT(ToSeat(*world), 0.02f);
  world->Apply({Edit(SeatEdit{0, -1}, EditCause::kOutside)});
  Steps(world.get(), 30);
  EXPECT_GT(ToSeat(*world), 0.1f) << "who gets out is let go";
}

TEST(Seat, NothingCollidesOnTheWay) {
  const auto alone = WithCharacter();
  Take(alone.get());
  const Vec2 was = PartPose(*alone, Named(*alone, "buggy")).position;
  Steps(alone.get(), SeatTicks(60) + 5);
  EXPECT_LT((PartPose(*alone, Named(*alone, "buggy")).position - was).norm(), 0.01f);
}

TEST(Seat, AReplayFromMidwayIsBitExact) {
  for (const int tick : {3, SeatWaitTicks(60), SeatWaitTicks(60) + 4, SeatTicks(60) + 2}) {
    const auto world = WithCharacter();
    Take(world.get());
    Steps(world.get(), tick);
    const WorldSnapshot snapshot = world->Barrier();
    Steps(world.get(), 25);
    const std::uint64_t hash = world->Hash();
    ASSERT_TRUE(world->Restore(snapshot).ok());
    Steps(world.get(), 25);
    EXPECT_EQ(world->Hash(), hash) << tick << " ticks after the seat was taken";
  }
}

TEST(Seat, TheVehicleReceivesTheCharactersMomentum) {
  const auto world = SmallWorld(R"(
[[player]]
name = "ann"
vehicle = "ann-body"
[[part]]
name = "ann-body"
box = [0.4, 0.8]
position = [0, 3]
velocity = [3, -1]
[[part]]
name = "cart"
box = [2, 0.5]
position = [2, 0]
density = 2
[[seat]]
name = "driver"
part = "cart"
at = [0, 0.7]
reach = 9
button = 5
)",
                                "substeps = 4\n", "gravity = [0, 0]");
  const auto momentum = [&] {
    Vec2 sum(0, 0);
    for (int b = 0; b < world->body_count(); ++b) {
      const BodyState state = world->Read(b);
      sum += world->mass(b) * state.velocity;
    }
    return sum;
  };
  const Vec2 before = momentum();
  Take(world.get());
  Steps(world.get(), SeatTicks(60));
  BondToSeat(world.get());
  ASSERT_EQ(world->body_count(), 1);
  EXPECT_LT((momentum() - before).norm(), 0.01f * before.norm());
}

TEST(Seat, ALeavingCharacterIsDrawnOutAndTheVehicleFeelsIt) {
  const auto world = WithCharacter();
  const PartId torso = Named(*world, "hero.torso");
  Take(world.get());
  Steps(world.get(), SeatTicks(60));
  BondToSeat(world.get());
  Steps(world.get(), 60);
  const auto bond = static_cast<std::int32_t>(world->scene().joints.size()) - 1;
  ASSERT_EQ(world->scene().joints[static_cast<std::size_t>(bond)].b, torso);
  const float sat = PartPose(*world, torso).position.y();
  world->Apply({Edit(BreakEdit{bond}, EditCause::kOutside)});
  world->Apply({Edit(SeatEdit{0, -1}, EditCause::kOutside)});
  const WorldSnapshot snapshot = world->Barrier();
  float highest = sat;
  for (int tick = 1; tick <= 60; ++tick) {
    const Vec2 before = PartPose(*world, torso).position;
    world->Step();
    const BodyState now = PartPose(*world, torso);
    EXPECT_LT((now.position - before).norm(), 0.06f) << "no jump, tick " << tick;
    highest = std::max(highest, now.position.y());
  }
  EXPECT_GT(highest, sat + 0.3f);
  const std::uint64_t hash = world->Hash();
  ASSERT_TRUE(world->Restore(snapshot).ok());
  Steps(world.get(), 60);
  EXPECT_EQ(world->Hash(), hash) << "bit for bit after going back";
}

TEST(Seat, ThePullIsBounded) {
  // A cart that is shoved away at 60 m/s when the way begins is not followed at once.
  const auto world = WithCharacter();
  const PartId torso = Named(*world, "hero.torso");
  Take(world.get());
  Steps(world.get(), SeatWaitTicks(60) + 2);
  const float mass =
      PartMass(world->scene().parts[static_cast<std::size_t>(Named(*world, "buggy"))]);
  world->Apply({Edit(PushEdit{Named(*world, "buggy"), {60 * mass, 0}}, EditCause::kOutside)});
  for (int tick = 0; tick < 20; ++tick) {
    const Vec2 before = PartPose(*world, torso).velocity;
    world->Step();
    const float change = (PartPose(*world, torso).velocity - before).norm();
    // 100 m/s^2 of the centre of all; the torso's own turns with the rest.
    EXPECT_LT(change, 2 * 100.0f / 60) << tick;
  }
}

}  // namespace seat_test
}  // namespace seam
