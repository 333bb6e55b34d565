/// Connectors: which pieces join, where, once, and when again.

#include "common/topology/join.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/physics/part_places.h"
#include "server/edits/proposal.h"
#include "tests/support/living_world.h"

namespace seam {
namespace join_test {

const char* const kNoGravity = "gravity = [0, 0]";

std::string Brick(const std::string& name, double x, double y, const std::string& more = "") {
  return "[[part]]\nname = \"" + name + "\"\nbox = [1, 1]\nposition = [" + FloatDigits(x) + ", " +
         FloatDigits(y) + "]\noutlets = [[0.5, 0, 0]]\ninlets = [[-0.5, 0, 3.14159265]]\n" + more +
         "\n";
}

TEST(Connectors, APieceThatComesNearJoinsAtTheExactPlaceAndKeepsMomentum) {
  auto world = SmallWorld(Brick("a", 0, 0) + Brick("b", 1.5, 0.03,
                                                   "angle = 0.05\nvelocity = [-1, 0]\n"
                                                   "density = 2\njoin_strength = 70"),
                          "", kNoGravity);
  const std::vector<Edit> edits = Live(world.get(), 60);
  ASSERT_EQ(edits.size(), 1u);
  ASSERT_EQ(world->body_count(), 1);
  const BodyState a = PartPose(*world, 0), b = PartPose(*world, 1);
  const Vec2 apart = b.position - a.position;
  EXPECT_NEAR(apart.norm(), 1, 1e-5);
  EXPECT_NEAR(apart.x(), std::cos(a.angle), 1e-5);
  EXPECT_NEAR(std::remainder(b.angle - a.angle, 2 * 3.14159265), 0, 1e-5);
  EXPECT_EQ(world->scene().joints.back().strength, 70);
  // 2 kg at 1 m/s before.
  EXPECT_NEAR(world->mass(0) * world->Read(0).velocity.x(), -2, 1e-5);
  EXPECT_NEAR(world->mass(0) * world->Read(0).velocity.y(), 0, 1e-5);
}

TEST(Connectors, AnInletTakesOneOutlet) {
  // Two outlets come to the one inlet of the middle part, which is half taken by the first.
  auto world = SmallWorld(Brick("middle", 0, 0) + Brick("left", -1.3, 0.05, "velocity = [1, 0]") +
                              Brick("late", -1.3, 1.2, "velocity = [0.3, -1]"),
                          "", kNoGravity);
  Live(world.get(), 120);
  int bonds = 0;
  for (const Joint& joint : world->scene().joints) bonds += joint.b == 0 ? 1 : 0;
  EXPECT_EQ(bonds, 1);
}

TEST(Connectors, MisalignedOrRecedingPiecesDoNotJoin) {
  auto turned = SmallWorld(Brick("a", 0, 0) + Brick("b", 1.05, 0,
                                                    "angle = 0.5\n"
                                                    "velocity = [-0.5, 0]"),
                           "", kNoGravity);
  EXPECT_TRUE(Live(turned.get(), 30).empty());
  auto away =
      SmallWorld(Brick("a", 0, 0) + Brick("b", 1.05, 0, "velocity = [0.5, 0]"), "", kNoGravity);
  EXPECT_TRUE(Live(away.get(), 30).empty());
  auto still = SmallWorld(Brick("a", 0, 0) + Brick("b", 1.05, 0), "", kNoGravity);
  EXPECT_TRUE(Live(still.get(), 30).empty());
}

TEST(Connectors, BrokenPiecesJoinAgainOnlyAfterASecond) {
  auto world = SmallWorld(
      Brick("a", 0, 0) + Brick("b", 1, 0) +
          "[[joint]]\nname = \"glue\"\nkind = \"glue\"\na = \"a\"\nb = \"b\"\nstrength = 5\n",
      "", kNoGravity);
  EXPECT_TRUE(Live(world.get(), 10).empty()) << "its connectors are taken";
  world->Apply({Edit(BreakEdit{0})});
  ASSERT_EQ(world->body_count(), 2);
  const auto push_together = [&world] {
    world->Write(0, BodyState{});
    world->Write(1, BodyState{{1.2f, 0}, 0, {-1, 0}, 0});
    return Live(world.get(), 20).size();
  };
  EXPECT_EQ(push_together(), 0u);
  EXPECT_EQ(push_together(), 0u);
  EXPECT_EQ(push_together(), 0u) << "59 ticks are over when they meet";
  EXPECT_EQ(push_together(), 1u);
  EXPECT_EQ(world->body_count(), 1);
}

TEST(Connectors, OnlyBondsOfConnectorsMayBeProposed) {
  auto world = SmallWorld(Brick("a", 0, 0) + Brick("b", 3, 0) +
                              "[[part]]\nname = \"plain\"\nbox = [1, 1]\nposition = [6, 0]\n",
                          "", kNoGravity);
  const Topology& topology = world->topology();
  const BondEdit join = JoinOf(topology.scene().parts[0], 0, topology.scene().parts[1], 0);
  EXPECT_TRUE(MayPropose(topology, Edit(join)));
  BondEdit wrong = join;
  wrong.position.x() += 0.1f;
  EXPECT_FALSE(MayPropose(topology, Edit(wrong)));
  wrong = join;
  wrong.strength = 1;
  EXPECT_FALSE(MayPropose(topology, Edit(wrong)));
  wrong = join;
  wrong.b = 2;
  EXPECT_FALSE(MayPropose(topology, Edit(wrong)));
  wrong = join;
  wrong.cause = BondCause::kGroup;
  EXPECT_FALSE(MayPropose(topology, Edit(wrong))) << "this scene does not group";
}

}  // namespace join_test
}  // namespace seam
