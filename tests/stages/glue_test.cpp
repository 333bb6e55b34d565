/// Glue that breaks: forces by arithmetic.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/stages/bonds/bond_net.h"
#include "tests/support/living_world.h"

namespace seam {
namespace glue_test {

/// Forces that hold a chain of `count` equal masses up by its first.
std::vector<Eigen::Vector2d> Hung(int count, double weight) {
  std::vector<Eigen::Vector2d> forces(static_cast<std::size_t>(count), Eigen::Vector2d(0, -weight));
  forces[0].y() += count * weight;
  return forces;
}

BondNet NetWith(int nodes, const std::vector<std::pair<int, int>>& bonds) {
  BondNet net;
  net.nodes = nodes;
  for (const auto& [a, b] : bonds) net.bonds.push_back({a, b, 0, 1});
  return net;
}

TEST(Glue, EachBondOfAHangingChainBearsTheWeightBelow) {
  std::vector<std::pair<int, int>> links;
  for (int i = 0; i + 1 < 50; ++i) links.push_back({i, i + 1});
  const std::vector<double> loads = BondLoads(NetWith(50, links), Hung(50, 3));
  for (int i = 0; i < 49; ++i) {
    EXPECT_NEAR(loads[static_cast<std::size_t>(i)], 3.0 * (49 - i), 1e-6);
  }
}

TEST(Glue, ParallelBondsShareEquallyAndALongerPathBearsLess) {
  const std::vector<Eigen::Vector2d> pulled = {{30, 40}, {-30, -40}};
  for (const double load : BondLoads(NetWith(2, {{0, 1}, {0, 1}, {0, 1}, {0, 1}}), pulled)) {
    EXPECT_NEAR(load, 50.0 / 4, 1e-9);
  }
  // A ring of five pulled at neighbours: springs in series are as much softer.
  std::vector<Eigen::Vector2d> ring(5, Eigen::Vector2d(0, 0));
  ring[0] = {10, 0};
  ring[1] = {-10, 0};
  const auto loads = BondLoads(NetWith(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}), ring);
  EXPECT_NEAR(loads[0], 8, 1e-9);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(loads[i], 2, 1e-9);
}

TEST(Glue, AnAnchorTakesTheUnbalancedForce) {
  BondNet net = NetWith(4, {{0, 1}, {1, 2}, {2, 3}});
  net.anchor = 0;
  const std::vector<double> loads = BondLoads(net, {{0, -1}, {0, -2}, {0, -3}, {0, -4}});
  EXPECT_NEAR(loads[0], 9, 1e-9);
  EXPECT_NEAR(loads[1], 7, 1e-9);
  EXPECT_NEAR(loads[2], 4, 1e-9);
}

/// Five boxes of 1 kg on a string, the first on a hinge.
std::string Chain(double strength) {
  return "[[part]]\nname = \"nail\"\nbox = [0.2, 0.2]\nposition = [0, 1]\nanchored = true\n"
         "[[part]]\nname = \"box\"\nbox = [1, 1]\n"
         "repeat = {count = 5, step = [0, -1], glue = " +
         FloatDigits(strength) +
         "}\n"
         "[[joint]]\nname = \"hook\"\nkind = \"revolute\"\na = \"nail\"\nb = \"box.0\"\n"
         "anchor = [0, 1]\n";
}

TEST(Glue, TheTopmostBondOfAHangingChainBreaksFirstAtTheWeightBelow) {
  // 4 kg hang below the first: 40 N. The hinge's own force is found to a part in a hundred.
  auto holds = SmallWorld(Chain(40.5));
  EXPECT_TRUE(Live(holds.get(), 200).empty());
  EXPECT_EQ(holds->body_count(), 1);
  auto breaks = SmallWorld(Chain(39.5));
  breaks->Step();
  const std::vector<Edit> proposed = breaks->ProposeEdits();
  ASSERT_EQ(proposed.size(), 1u);
  EXPECT_EQ(
      breaks->scene().joints[static_cast<std::size_t>(proposed[0].As<BreakEdit>()->joint)].name,
      "box.h.0");
}

TEST(Glue, ACantileverOnAWallBreaksAtTheWall) {
  const auto beam = [](double strength) {
    return "[[part]]\nname = \"wall\"\nbox = [1, 1]\nposition = [-1, 0]\nanchored = true\n"
           "[[part]]\nname = \"box\"\nbox = [1, 1]\n"
           "repeat = {count = 3, step = [1, 0], glue = 1000}\n"
           "[[joint]]\nname = \"root\"\nkind = \"glue\"\na = \"wall\"\nb = \"box.0\"\n"
           "strength = " +
           FloatDigits(strength) + "\n";
  };
  auto holds = SmallWorld(beam(30.1));
  EXPECT_TRUE(Live(holds.get(), 60).empty());
  auto breaks = SmallWorld(beam(29.9));
  EXPECT_EQ(Live(breaks.get(), 60).size(), 1u);
  EXPECT_EQ(breaks->body_count(), 1) << "what broke off falls";
  EXPECT_LT(breaks->Read(0).position.y(), -3);
}

TEST(Glue, ASpinningPairBreaksAtMassTimesSpinSquaredTimesRadius) {
  const auto two = [](double strength) {
    return "[[part]]\nname = \"box\"\nbox = [1, 1]\nspin = 10\n"
           "repeat = {count = 2, step = [1, 0], glue = " +
           FloatDigits(strength) + "}\n";
  };
  // 1 kg at 0.5 m, 10 rad/s: 50 N.
  auto holds = SmallWorld(two(50.1), "", "gravity = [0, 0]");
  EXPECT_TRUE(Live(holds.get(), 60).empty());
  auto breaks = SmallWorld(two(49.9), "", "gravity = [0, 0]");
  EXPECT_EQ(Live(breaks.get(), 60).size(), 1u);
  EXPECT_EQ(breaks->body_count(), 2);
}

TEST(Glue, AnImpactStrainsABondByTheShareOfMassBehindIt) {
  // 1 kg at 10 m/s stops against 1 + 1 kg: 6.667 N s, half of it through the bond: 200 N at 60 Hz.
  const auto blow = [](double strength) {
    return "[[part]]\nname = \"ram\"\nbox = [1, 1]\nposition = [-3, 0]\nvelocity = [10, 0]\n"
           "[[part]]\nname = \"box\"\nbox = [1, 1]\n"
           "repeat = {count = 2, step = [1, 0], glue = " +
           FloatDigits(strength) + "}\n";
  };
  auto holds = SmallWorld(blow(206), "", "gravity = [0, 0]");
  EXPECT_TRUE(Live(holds.get(), 60).empty());
  auto breaks = SmallWorld(blow(194), "", "gravity = [0, 0]");
  EXPECT_EQ(Live(breaks.get(), 60).size(), 1u);
}

TEST(Glue, AStrongHouseStandsAndSleepsUnbroken) {
  const std::string house =
      "[[part]]\nname = \"ground\"\nchain = [[-20, 0], [20, 0]]\n"
      "[[part]]\nname = \"brick\"\nbox = [1, 0.5]\nposition = [0, 0.27]\n"
      "repeat = {count = [4, 6], step = [1, 0.5], glue = 130}\n";  // weighs 120 N
  auto world = SmallWorld(house);
  EXPECT_TRUE(Live(world.get(), 300).empty());
  EXPECT_EQ(world->body_count(), 1);
}

TEST(Glue, AWeldBesideABondKeepsItFromBreaking) {
  auto world = SmallWorld(
      "[[part]]\nname = \"box\"\nbox = [1, 1]\nspin = 20\n"
      "repeat = {count = 2, step = [1, 0], glue = 1}\n"
      "[[joint]]\nname = \"weld\"\nkind = \"weld\"\na = \"box.0\"\nb = \"box.1\"\n",
      "", "gravity = [0, 0]");
  EXPECT_TRUE(Live(world.get(), 30).empty());
}

TEST(Glue, TheSameBondsBreakAgainAfterGoingBack) {
  auto world = SmallWorld(
      "[[part]]\nname = \"ground\"\nchain = [[-20, 0], [20, 0]]\n"
      "[[part]]\nname = \"ball\"\ncircle = 0.6\ndensity = 5\nposition = [-6, 1.5]\n"
      "velocity = [14, 0]\n"
      "[[part]]\nname = \"brick\"\nbox = [1, 0.5]\nposition = [0, 0.27]\n"
      "repeat = {count = [3, 6], step = [1, 0.5], glue = 300}\n");
  Steps(world.get(), 15);
  const WorldSnapshot snapshot = world->Barrier();
  const auto proposed = [&world] {
    std::vector<int> joints;
    for (int i = 0; i < 20; ++i) {
      world->Step();
      for (const Edit& edit : world->ProposeEdits()) joints.push_back(edit.As<BreakEdit>()->joint);
    }
    return joints;
  };
  const std::vector<int> first = proposed();
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(world->Restore(snapshot).ok());
  EXPECT_EQ(proposed(), first);
}

}  // namespace glue_test
}  // namespace seam
