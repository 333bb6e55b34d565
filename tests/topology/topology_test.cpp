/// Bodies that split and merge while they move: arithmetic of momentum, places, and order.

#include "common/topology/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/mass.h"
#include "tests/support/small_world.h"

namespace seam {
namespace topology_test {

std::string Part(const std::string& name, double width, double height, double x, double y,
                 const std::string& more = "") {
  return "[[part]]\nname = \"" + name + "\"\nbox = [" + FloatDigits(width) + ", " +
         FloatDigits(height) + "]\nposition = [" + FloatDigits(x) + ", " + FloatDigits(y) + "]\n" +
         more + "\n";
}

std::string Joint(const std::string& kind, const std::string& a, const std::string& b,
                  const std::string& more = "") {
  return "[[joint]]\nname = \"" + a + "-" + b + "\"\nkind = \"" + kind + "\"\na = \"" + a +
         "\"\nb = \"" + b + "\"\n" + more + "\n";
}

const char* const kNoGravity = "gravity = [0, 0]";

Edit Break(int joint) { return Edit(BreakEdit{joint}); }

Edit Bond(PartId a, PartId b, float x, float y, float angle) {
  return Edit(BondEdit{a, b, {x, y}, angle});
}

/// Momentum, and angular momentum about the origin, of all moving bodies.
struct Momentum {
  Eigen::Vector2d linear{0, 0};
  double angular = 0;
};

Momentum MomentumOf(const World& world) {
  Momentum sum;
  int body = 0;
  for (const Assembly& assembly : world.composition().assemblies) {
    if (assembly.anchored) continue;
    const MassProperties own = AssemblyProperties(world.scene(), assembly);
    const BodyState state = world.Read(body++);
    const double angle = static_cast<double>(state.angle);
    const double c = std::cos(angle), s = std::sin(angle);
    const Eigen::Vector2d arm(c * own.centre.x() - s * own.centre.y(),
                              s * own.centre.x() + c * own.centre.y());
    const Eigen::Vector2d centre = state.position.cast<double>() + arm;
    const Eigen::Vector2d velocity = state.velocity.cast<double>();
    sum.linear += own.mass * velocity;
    sum.angular += own.inertia * static_cast<double>(state.spin) +
                   own.mass * (centre.x() * velocity.y() - centre.y() * velocity.x());
  }
  return sum;
}

/// Pose of a part, in whichever body it is.
BodyState WhereIs(const World& world, PartId part) {
  const Composition& c = world.composition();
  const Assembly& assembly =
      c.assemblies[static_cast<std::size_t>(c.assembly_of_part[static_cast<std::size_t>(part)])];
  const BodyState root = world.Read(world.BodyOfId(assembly.id));
  const auto& parts = world.scene().parts;
  const Eigen::Vector2d local = ToRootFrame(parts[static_cast<std::size_t>(part)],
                                            parts[static_cast<std::size_t>(assembly.id)], {0, 0});
  const double angle = static_cast<double>(root.angle);
  BodyState out = root;
  out.position = (root.position.cast<double>() +
                  Eigen::Vector2d(std::cos(angle) * local.x() - std::sin(angle) * local.y(),
                                  std::sin(angle) * local.x() + std::cos(angle) * local.y()))
                     .cast<float>();
  out.angle = root.angle + parts[static_cast<std::size_t>(part)].angle -
              parts[static_cast<std::size_t>(assembly.id)].angle;
  return out;
}

/// Three glued boxes of different weight, thrown with a spin.
std::unique_ptr<World> Thrown() {
  auto world = SmallWorld(
      Part("a", 1, 1, 0, 0) + Part("b", 2, 1, 1.5, 0) + Part("c", 0.5, 1, 2.75, 0, "density = 3") +
          Joint("glue", "a", "b", "strength = 10") + Joint("glue", "b", "c", "strength = 10"),
      "", kNoGravity);
  EXPECT_EQ(world->body_count(), 1);
  BodyState state = world->Read(0);
  state.velocity = {3, -2};
  state.spin = 4;
  world->Write(0, state);
  Steps(world.get(), 17);
  return world;
}

TEST(Topology, ABrokenBondSplitsABodyAndKeepsMomentumAndAngularMomentum) {
  auto world = Thrown();
  const Momentum before = MomentumOf(*world);
  const BodyState a = WhereIs(*world, 0), b = WhereIs(*world, 1), c = WhereIs(*world, 2);
  const auto change = world->Apply({Break(1)});
  ASSERT_TRUE(change.has_value());
  ASSERT_EQ(world->body_count(), 2);
  EXPECT_EQ(world->id(0), 1);
  EXPECT_EQ(world->id(1), 2);
  const Momentum after = MomentumOf(*world);
  EXPECT_NEAR(after.linear.x(), before.linear.x(), 1e-5);
  EXPECT_NEAR(after.linear.y(), before.linear.y(), 1e-5);
  EXPECT_NEAR(after.angular, before.angular, 2e-5);
  // Nobody jumps, and each piece moves as it moved.
  EXPECT_NEAR((WhereIs(*world, 0).position - a.position).norm(), 0, 1e-6);
  EXPECT_NEAR((WhereIs(*world, 1).position - b.position).norm(), 0, 1e-6);
  EXPECT_NEAR((WhereIs(*world, 2).position - c.position).norm(), 0, 1e-6);
  EXPECT_NEAR(world->Read(1).spin, 4, 1e-6);
}

TEST(Topology, ARegluedBodyMovesAsIfNeverBroken) {
  auto broken = Thrown(), whole = Thrown();
  broken->Apply({Break(1)});
  broken->Apply({Bond(1, 2, 1.25f, 0, 0)});
  ASSERT_EQ(broken->body_count(), 1);
  Steps(broken.get(), 60);
  Steps(whole.get(), 60);
  EXPECT_NEAR((broken->Read(0).position - whole->Read(0).position).norm(), 0, 2e-5);
  EXPECT_NEAR(broken->Read(0).spin, whole->Read(0).spin, 1e-5);
}

TEST(Topology, TwoBodiesThatBondKeepTheirMomentumTogether) {
  auto world = SmallWorld(Part("a", 1, 1, 0, 0, "velocity = [2, 1]\nspin = 3") +
                              Part("b", 1, 1, 1.2, 0.3,
                                   "density = 2\nvelocity = [-1, 0.5]\n"
                                   "spin = -1\nangle = 0.3"),
                          "", kNoGravity);
  const Momentum before = MomentumOf(*world);
  // Exactly as they are: nothing moves, so the angular momentum is the same, too.
  const double turn = -0.0;
  world->Apply({Bond(0, 1, 1.2f, 0.3f, 0.3f + static_cast<float>(turn))});
  ASSERT_EQ(world->body_count(), 1);
  EXPECT_EQ(world->id(0), 1) << "the heavier is the root";
  const Momentum after = MomentumOf(*world);
  EXPECT_NEAR(after.linear.x(), before.linear.x(), 1e-6);
  EXPECT_NEAR(after.linear.y(), before.linear.y(), 1e-6);
  EXPECT_NEAR(after.angular, before.angular, 2e-6);
}

TEST(Topology, BondsMoveThePlacesOfAWholeSide) {
  // c hangs on b; b bonds with a elsewhere than the scene has it.
  auto world = SmallWorld(Part("a", 2, 2, 0, 0) + Part("b", 1, 1, 5, 5) + Part("c", 1, 1, 6, 5) +
                              Joint("weld", "b", "c"),
                          "", kNoGravity);
  const double quarter = 1.5707963267948966;
  world->Apply({Bond(0, 1, 0, 1.5f, static_cast<float>(quarter))});
  ASSERT_EQ(world->body_count(), 1);
  const BodyState b = WhereIs(*world, 1), c = WhereIs(*world, 2);
  EXPECT_NEAR((b.position - Vec2(0, 1.5f)).norm(), 0, 1e-6);
  EXPECT_NEAR((c.position - Vec2(0, 2.5f)).norm(), 0, 1e-6);
  EXPECT_NEAR(c.angle, quarter, 1e-6);
}

TEST(Topology, AHingeStillHoldsWhenItsBodyIsBonded) {
  auto world = SmallWorld(Part("ground", 1, 1, 0, 5, "anchored = true") +
                          Part("rod", 1, 0.2, 1, 5) + Part("tip", 0.4, 0.4, 4, 4) +
                          Joint("revolute", "ground", "rod", "anchor = [0.5, 5]"));
  world->Apply({Bond(2, 1, 0.7f, 0, 0)});  // the tip is heavier... or not: either side may move
  Steps(world.get(), 120);
  const BodyState rod = WhereIs(*world, 1);
  const float c = std::cos(rod.angle), s = std::sin(rod.angle);
  const Vec2 end = rod.position + Vec2(-0.5f * c, -0.5f * s);
  EXPECT_NEAR((end - Vec2(0.5f, 5)).norm(), 0, 0.01);
  EXPECT_GT(world->Read(0).position.y(), 0) << "it hangs";
}

TEST(Topology, AStackStandsOnThroughAnEditElsewhere) {
  const std::string parts =
      Part("floor", 20, 1, 0, -0.5, "anchored = true") + Part("low", 1, 1, 0, 0.515) +
      Part("mid", 1, 1, 0, 1.53) + Part("top", 1, 1, 0, 2.545) + Part("x", 0.5, 0.5, 6, 0.265) +
      Part("y", 0.5, 0.5, 6.5, 0.265) + Joint("glue", "x", "y", "strength = 5");
  auto world = SmallWorld(parts);
  Steps(world.get(), 120);
  const BodyState before = world->Read(world->BodyOfId(3));
  world->Apply({Break(0)});
  world->Step();
  // The impulses of contacts came along: without them it would fall g h^2 = 2.8 mm into the next.
  const BodyState after = world->Read(world->BodyOfId(3));
  EXPECT_NEAR((after.position - before.position).norm(), 0, 2e-5);
  EXPECT_LT(after.velocity.norm(), 2e-3);
}

TEST(Topology, ImpossibleEditsCountAndDoNothing) {
  auto world = Thrown();
  const std::uint64_t hash = world->composition().hash;
  const Edit insert(InsertEdit{"[[part]]\nname = \"a\"\nbox = [1, 1]\n"});  // a name that is taken
  const Edit remove(RemoveEdit{99});
  EXPECT_FALSE(world
                   ->Apply({Break(7), Break(-1), Bond(0, 1, 0, 0, 0), Bond(0, 9, 0, 0, 0), insert,
                            remove, Edit{}})
                   .has_value());
  EXPECT_EQ(world->topology().revision(), 7);
  EXPECT_EQ(world->composition().hash, hash);
}

TEST(Topology, ABondThatIsNotFiniteOrTurnsWithoutEndIsRefused) {
  auto world = Thrown();
  const float inf = std::numeric_limits<float>::infinity();
  for (const float angle : {3e38f, inf, -inf, std::nanf(""), 6.3f}) {
    EXPECT_FALSE(world->topology().Validate(Bond(2, 0, 1, 0.5f, angle)).ok()) << angle;
    world->Apply({Bond(2, 0, 1, 0.5f, angle)});
    world->Step();  // an angle of 3e38 aborted the engine here
  }
  EXPECT_FALSE(world->topology().Validate(Bond(2, 0, inf, 0, 0)).ok());
  EXPECT_FALSE(world->topology().Validate(Bond(2, 0, 0, std::nanf(""), 0)).ok());
}

TEST(Topology, TheSameEditsGiveTheSameCompositionWhetherAtOnceOrOneByOne) {
  const std::vector<Edit> edits = {Break(0), Bond(2, 0, 1, 0.5f, 0.2f), Break(1), Break(2)};
  auto together = Thrown(), apart = Thrown();
  together->Apply(edits);
  for (const Edit& edit : edits) apart->Apply({edit});
  EXPECT_EQ(together->composition().hash, apart->composition().hash);
  EXPECT_EQ(together->topology().revision(), apart->topology().revision());
}

TEST(Topology, PartsComeAndGo) {
  auto world = SmallWorld(Part("a", 1, 1, 0, 0), "", kNoGravity);
  const Edit insert(
      InsertEdit{Part("new", 0.5, 0.5, 3, 0, "velocity = [1, 0]") +
                 Joint("revolute", "a", "new", "local_a = [1, 0]\nlocal_b = [-2, 0]")});
  ASSERT_TRUE(world->Apply({insert}).has_value());
  ASSERT_EQ(world->body_count(), 2);
  EXPECT_EQ(world->mechanism(0), world->mechanism(1));
  EXPECT_EQ(world->Read(1).velocity, Vec2(1, 0));
  const Edit remove(RemoveEdit{0});
  ASSERT_TRUE(world->Apply({remove}).has_value());
  ASSERT_EQ(world->body_count(), 1);
  EXPECT_EQ(world->id(0), 1);
  EXPECT_EQ(world->BodyOfId(0), -1);
  Steps(world.get(), 60);
  EXPECT_GT(world->Read(0).position.x(), 3.4f);
}

TEST(Topology, AFreedPartFalls) {
  auto world = SmallWorld(Part("held", 1, 1, 0, 5, "anchored = true") + Part("hung", 1, 1, 1, 5) +
                          Joint("weld", "held", "hung"));
  EXPECT_EQ(world->body_count(), 0);
  const Edit free(FreeEdit{0});
  ASSERT_TRUE(world->Apply({free}).has_value());
  ASSERT_EQ(world->body_count(), 1);
  Steps(world.get(), 30);
  // v = g t to rounding; y after n steps of h is n (n + 1) / 2 g h^2 below.
  EXPECT_NEAR(world->Read(0).velocity.y(), -5, 1e-4);
  EXPECT_NEAR(world->Read(0).position.y(), 5 - 10.0 / 3600 * 30 * 31 / 2, 1e-3);
}

TEST(Topology, APushChangesTheVelocityByImpulseOverMass) {
  auto world = SmallWorld(Part("a", 2, 1, 0, 0), "", kNoGravity);
  const Edit push(PushEdit{0, {4, 0}, 1});
  EXPECT_FALSE(world->Apply({push}).has_value());
  EXPECT_FLOAT_EQ(world->Read(0).velocity.x(), 2);
  EXPECT_NEAR(world->Read(0).spin, 1 / (2 * 5.0 / 12), 1e-6);
}

TEST(Topology, HistoryIsCarriedOverAsARigidMotion) {
  auto world = Thrown();
  const BodyState then = world->Read(0);
  const BodyState c_then = WhereIs(*world, 2);
  const auto change = world->Apply({Break(1)});
  const BodyState carried = Carried(change->bodies[1], then);
  EXPECT_NEAR((carried.position - c_then.position).norm(), 0, 1e-6);
  EXPECT_NEAR((carried.velocity - world->Read(1).velocity).norm(), 0, 1e-5);
}

/// Two links that hang on a box, and a sledge of two boxes.
std::unique_ptr<World> BoxWithLinks() {
  const std::string scene = Part("box", 1, 1, 0, 0, "velocity = [1, 2]") +
                            Part("arm", 0.2, 1, 0, -1) + Part("hand", 0.2, 0.4, 0, -1.7) +
                            Part("sledge", 2, 1, 6, 1) + Part("skid", 2, 0.2, 6, 0) +
                            Joint("revolute", "box", "arm", "anchor = [0, -0.5]") +
                            Joint("revolute", "arm", "hand", "anchor = [0, -1.5]") +
                            Joint("revolute", "sledge", "skid", "anchor = [6, 0.5]");
  return SmallWorld(scene, "", kNoGravity);
}

TEST(Topology, ABondCarriesTheWholeMechanismAlong) {
  const auto world = BoxWithLinks();
  Steps(world.get(), 20);
  const Momentum before = MomentumOf(*world);
  const BodyState box = PartPose(*world, 0), hand = PartPose(*world, 2);
  const BodyState skid = PartPose(*world, 4);
  const std::optional<BodyRemap> change = world->Apply({Bond(3, 0, 0, 2, 0.5f)});
  ASSERT_TRUE(change);
  const BodyState box_now = PartPose(*world, 0), hand_now = PartPose(*world, 2);
  EXPECT_GT((box_now.position - box.position).norm(), 3);
  const Vec2 then = Turned(Vec2(hand.position - box.position), -box.angle);
  const Vec2 now = Turned(Vec2(hand_now.position - box_now.position), -box_now.angle);
  EXPECT_LT((now - then).norm(), 1e-5f) << "the hand is where it was, seen from the box";
  EXPECT_NEAR(hand_now.angle - hand.angle, box_now.angle - box.angle, 1e-5);
  EXPECT_EQ(PartPose(*world, 4).position, skid.position) << "what the box came to stays";
  EXPECT_LT((MomentumOf(*world).linear - before.linear).norm(), 1e-5);
  ASSERT_EQ(static_cast<int>(change->jumps.size()), world->body_count());
  const BodyState& jump = change->jumps[static_cast<std::size_t>(world->BodyOfId(2))];
  EXPECT_LT((jump.position - (hand_now.position - hand.position)).norm(), 1e-5f);
}

TEST(Topology, ABondWithinAMechanismCarriesNothingAlong) {
  const auto world = BoxWithLinks();
  const BodyState arm = PartPose(*world, 1);
  const std::optional<BodyRemap> change = world->Apply({Bond(0, 2, 0, -2, 0)});
  ASSERT_TRUE(change);
  EXPECT_TRUE(change->jumps.empty());
  EXPECT_EQ(PartPose(*world, 1).position, arm.position);
}

TEST(Topology, ABondWithAnAnchoredPartCarriesTheMechanismAlong) {
  const std::string scene = Part("box", 1, 1, 0, 0) + Part("arm", 0.2, 1, 0, -1) +
                            Part("post", 1, 4, 5, 0, "anchored = true") +
                            Joint("revolute", "box", "arm", "anchor = [0, -0.5]");
  const auto world = SmallWorld(scene, "", kNoGravity);
  ASSERT_TRUE(world->Apply({Bond(2, 0, 0, 3, 0)}));
  EXPECT_LT((PartPose(*world, 1).position - Vec2(5, 2)).norm(), 1e-5f);
}

TEST(Topology, APushBeyondTheLimitIsRefusedAndOneAtItStaysFinite) {
  const auto world = SmallWorld(Part("mote", 0.05, 0.05, 0, 0, "density = 0.01"), "", kNoGravity);
  const float most = 1e9f, inf = std::numeric_limits<float>::infinity();
  for (const float much : {2 * most, 3e38f, inf, -inf, std::nanf("")}) {
    EXPECT_FALSE(world->topology().Validate(Edit(PushEdit{0, {much, 0}})).ok()) << much;
    EXPECT_FALSE(world->topology().Validate(Edit(PushEdit{0, {0, 0}, much})).ok()) << much;
  }
  ASSERT_TRUE(world->topology().Validate(Edit(PushEdit{0, {most, 0}, most})).ok());
  world->Apply({Edit(PushEdit{0, {most, 0}, most})});
  Steps(world.get(), 20);
  EXPECT_TRUE(world->Read(0).position.allFinite());
  EXPECT_TRUE(std::isfinite(world->Read(0).angle));
}

}  // namespace topology_test
}  // namespace seam
