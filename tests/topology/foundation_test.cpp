/// Foundations of bricks: the anchored parts under them; for a building without any, its own lowest
/// rows.

#include "common/topology/foundation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/topology/topology.h"
#include "common/topology/topology_builder.h"
#include "common/topology/topology_fold.h"

namespace seam {
namespace foundation_test {

std::string Ground(const std::string& points) {
  return "[[part]]\nname = \"ground\"\nchain = [" + points + "]\n";
}

/// A scene must have a part: one that holds nothing.
const std::string kBall = "[[part]]\nname = \"ball\"\ncircle = 0.2\nposition = [40, 40]\n";

/// From x, y so many bricks of half a metre by a quarter.
std::string Bricks(const std::string& name, double x, double y, int columns, int rows) {
  return "[[bricks]]\nname = \"" + name + "\"\nbrick = [0.5, 0.25]\nposition = [" +
         std::to_string(x) + ", " + std::to_string(y) + "]\ncount = [" + std::to_string(columns) +
         ", " + std::to_string(rows) + "]\n";
}

Edit At(float x, float y, float radius) { return Edit(BlastEdit{{x, y}, radius, 20}); }

bool Came(const Topology& topology, const std::string& bricks) {
  const auto& parts = topology.scene().parts;
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Part& part) { return part.name.rfind(bricks + "@", 0) == 0; });
}

Topology After(const std::string& text, const std::vector<Edit>& edits) {
  Topology topology(ParseScene(text, "bricks.toml"));
  topology.Apply(edits);
  for (int more = 0; more < 20 && topology.hanging().has_value(); ++more) {
    topology.Apply({Edit(BlastEdit{*topology.hanging(), 0.5f, 0, 0})});
  }
  return topology;
}

/// A house at 0..4 m on the ground, and steps at -2..0 m that begin a metre lower.
const std::string kSteps = Bricks("house", 0, 0, 8, 12) + Bricks("steps", -2, -1, 4, 6);

TEST(Foundations, AHouseOnTheGroundOutlivesTheStepsThatItTouches) {
  const std::string text = Ground("[-50, -1], [0, -1], [0, 0], [50, 0]") + kSteps;
  const Topology cut = After(text, {At(-1, -0.3f, 1.6f), At(-1, 0.2f, 1.6f)});
  EXPECT_TRUE(Came(cut, "steps"));
  const Topology gone = After(text, {At(-0.3f, 0.1f, 0.8f), At(-0.2f, -0.6f, 0.8f)});
  EXPECT_TRUE(Came(gone, "house")) << "what the blast took";
  EXPECT_GT(gone.BricksLeft().size(), 85u) << "but the house stands";
}

TEST(Foundations, AHouseOnTheGroundFallsWhenItsOwnFootGoes) {
  const std::string text =
      Ground("[-50, -1], [0, -1], [0, 0], [50, 0]") + Bricks("house", 0, 0, 3, 12);
  const Topology fallen = After(text, {At(0.75f, 0.6f, 1)});
  EXPECT_LT(fallen.BricksLeft().size(), 6u);
}

/// Two piers on the ground, a deck on them, a lamp below its middle.
const std::string kBridge = Bricks("left", 0, 0, 1, 16) + Bricks("right", 9.5, 0, 1, 16) +
                            Bricks("deck", 0, 4, 20, 2) + Bricks("lamp", 4.5, 3, 1, 4);

TEST(Foundations, ALampBelowABridgeDoesNotHoldIt) {
  const std::string text = Ground("[-50, 0], [50, 0]") + kBridge;
  const Topology one = After(text, {At(0.25f, 2, 0.6f)});
  EXPECT_FALSE(Came(one, "deck")) << "one pier stands";
  EXPECT_FALSE(Came(one, "lamp"));
  const Topology both = After(text, {At(0.25f, 2, 0.6f), At(9.75f, 2, 0.6f)});
  EXPECT_TRUE(Came(both, "deck"));
  EXPECT_TRUE(Came(both, "lamp"));
  EXPECT_LT(both.BricksLeft().size(), 16u) << "stumps";
}

TEST(Foundations, ALampOverAStreetOfBricksDoesNotHoldTheBridgeEither) {
  const std::string text = kBall + Bricks("street", -5, -0.5, 40, 2) + kBridge;
  const Topology both = After(text, {At(0.25f, 2, 0.6f), At(9.75f, 2, 0.6f)});
  EXPECT_TRUE(Came(both, "deck"));
  EXPECT_TRUE(Came(both, "lamp"));
  EXPECT_FALSE(Came(both, "street")) << "it stands by itself";
}

TEST(Foundations, ADeckBetweenTwoCliffsFallsAsOneWhenCutAtBoth) {
  const std::string cliffs =
      "[[part]]\nname = \"west\"\nbox = [10, 10]\nposition = [-5, -5]\nanchored = true\n"
      "[[part]]\nname = \"east\"\nbox = [10, 10]\nposition = [15, -5]\nanchored = true\n";
  const std::string text = cliffs + Bricks("deck", -2, 0, 28, 2);
  const Topology one = After(text, {At(0.5f, 0.25f, 0.5f)});
  EXPECT_GT(one.BricksLeft().size(), 45u);
  const Topology both = After(text, {At(0.5f, 0.25f, 0.5f), At(9.5f, 0.25f, 0.5f)});
  EXPECT_LE(both.BricksLeft().size(), 20u) << "what lies on the cliffs";
  EXPECT_GE(both.BricksLeft().size(), 12u);
}

TEST(Foundations, EachTowerOfARowStandsOrFallsByItself) {
  // The kiosk begins lower and touches the first tower only; there is no ground.
  const std::string text = kBall +
                           "[[bricks]]\nname = \"towers\"\nbrick = [0.5, 0.25]\nposition = [0, 0]\n"
                           "towers = {count = 3, pitch = 8, width = [4, 4], height = [6, 6]}\n" +
                           Bricks("kiosk", -1, -1, 2, 8);
  const Topology second = After(text, {At(10, 2, 1)});
  EXPECT_GT(second.BricksLeft().size(), 500u) << "it stands by its lowest row";
  const Topology first = After(text, {At(0.1f, 0.5f, 1), At(0.1f, -0.5f, 1)});
  EXPECT_LT(first.BricksLeft().size(), 420u) << "it hung on the kiosk";
}

/// A tower of 2 m on the part, with a wall beside it that begins lower; is it up when that is gone?
bool Stands(const std::string& part, double bottom = 0) {
  const std::string text =
      kBall + part + Bricks("tower", 0, bottom, 1, 8) + Bricks("wall", 0.5, bottom - 4.5, 1, 20);
  const auto y = static_cast<float>(bottom);
  const Topology topology =
      After(text, {At(0.75f, y - 3, 1.1f), At(0.9f, y - 1.2f, 1), At(0.95f, y + 0.1f, 0.5f)});
  return !Came(topology, "tower");
}

std::string Anchored(const std::string& shape) {
  return "[[part]]\nname = \"rock\"\nanchored = true\n" + shape + "\n";
}

TEST(Foundations, EveryShapeSupportsBricksOnIt) {
  EXPECT_TRUE(Stands(Ground("[-9, 0], [0.5, 0], [0.5, -9], [9, -9]")));
  EXPECT_TRUE(Stands(Ground("[-9, 3], [0.5, -0.2], [0.5, -9], [9, -9]"))) << "a slope";
  EXPECT_TRUE(Stands("[[part]]\nname = \"s\"\nsegment = [[0.5, 0], [-2, 0]]\n"));
  EXPECT_TRUE(Stands(Anchored("box = [1, 2]\nposition = [0, -1]")));
  EXPECT_TRUE(Stands(Anchored("box = [2, 1]\nposition = [0, -1]\nangle = 1.5707963")));
  EXPECT_TRUE(Stands(Anchored("box = [2, 1]\nposition = [0, -1]\nangle = -7.85398")));
  EXPECT_TRUE(
      Stands(Anchored("polygon = [[-1, -1], [0.5, -1], [0.5, 1], [-1, 1]]\n"
                      "position = [0, -1]")));
  EXPECT_TRUE(
      Stands(Anchored("polygon = [[-1, 1], [0.5, 1], [0.5, -1], [-1, -1]]\n"
                      "position = [0, -1]")));
  EXPECT_TRUE(Stands(Anchored("circle = 2\nposition = [0.2, -2]")));
  EXPECT_TRUE(Stands(Anchored("capsule = [2, 1]\nposition = [-0.5, -1]")));
  EXPECT_TRUE(Stands(Anchored("capsule = [2, 0.5]\nposition = [0.1, -1.5]\nangle = 1.5707963")));
  EXPECT_TRUE(Stands(Anchored("wedge = [-2, 2]\nposition = [0.2, -0.1]")));
  EXPECT_TRUE(Stands(Anchored("box = [1, 2]\nposition = [0, -1.05]"))) << "5 cm below";
  EXPECT_TRUE(Stands(Anchored("box = [1, 2]\nposition = [0, -0.4]"))) << "it stands in it";
  EXPECT_TRUE(Stands(Anchored("box = [1, 2]\nposition = [0, 19]"), 20)) << "anywhere";
}

TEST(Foundations, ShapesBesideAboveOrFurtherBelowDoNotSupport) {
  EXPECT_FALSE(Stands(""));
  EXPECT_FALSE(Stands(Anchored("box = [1, 9]\nposition = [-0.5, 0]"))) << "a rock beside it";
  EXPECT_FALSE(Stands(Anchored("box = [1, 2]\nposition = [0.25, 3]"))) << "it hangs below that";
  EXPECT_FALSE(Stands(Anchored("box = [1, 2]\nposition = [0, -1.07]"))) << "7 cm below";
  EXPECT_FALSE(Stands(Ground("[9, 2], [-9, 2]"))) << "a ceiling is open below";
  EXPECT_FALSE(Stands(Ground("[9, 0], [-9, 0]")));
  EXPECT_FALSE(Stands(Anchored("box = [1, 2]\nposition = [0, -1]") +
                      "[[joint]]\nname = \"lift\"\nkind = \"kinematic\"\nb = \"rock\"\n"
                      "path = [[0, 0], [0, 4]]\nperiod = 8\n"))
      << "what moves is no ground";
}

const std::string kPedestal =
    Ground("[-50, -5], [50, -5]") +
    "[[part]]\nname = \"rock\"\nanchored = true\nbox = [3, 5]\nposition = [1, -2.5]\n";

TEST(Foundations, BricksOnAPartFallWhenItIsRemovedOrFreed) {
  const std::string text = kPedestal + Bricks("hut", 0, 0, 4, 8);
  for (const Edit& edit : {Edit(RemoveEdit{1}), Edit(FreeEdit{1})}) {
    Topology topology(ParseScene(text, "hut.toml"));
    topology.Apply({edit});
    ASSERT_TRUE(topology.hanging().has_value());
    EXPECT_FALSE(Came(topology, "hut")) << "by the next edit, which the server orders";
    topology.Apply({Edit(BlastEdit{*topology.hanging(), 0.5f, 0, 0})});
    EXPECT_EQ(topology.BricksLeft().size(), 0u);
    EXPECT_FALSE(topology.hanging().has_value());
  }
  Topology other(ParseScene(text, "hut.toml"));
  other.Apply({Edit(RemoveEdit{0})});
  EXPECT_FALSE(other.hanging().has_value()) << "it does not lie on that one";
}

TEST(Foundations, OneOfTwoPartsSuffices) {
  const std::string text =
      kPedestal + Anchored("box = [1, 5]\nposition = [3.5, -2.5]") + Bricks("hut", 0, 0, 8, 8);
  std::string two = text;
  two.replace(two.rfind("rock"), 4, "post");
  EXPECT_EQ(After(two, {Edit(RemoveEdit{1})}).BricksLeft().size(), 64u);
  EXPECT_EQ(After(two, {Edit(RemoveEdit{1}), Edit(RemoveEdit{2})}).BricksLeft().size(), 0u);
}

TEST(Foundations, ALatecomerHasTheSameBricks) {
  const std::string text = kPedestal + Bricks("hut", 0, 0, 4, 8) + Bricks("low", 4, -5, 4, 8) +
                           Bricks("deck", 2, 0, 8, 1);
  const Scene scene = ParseScene(text, "join.toml");
  Topology live(scene);
  TopologyFold fold(live);
  for (const Edit& edit : {At(2.5f, 0.1f, 0.3f), Edit(FreeEdit{1}), At(4.2f, -4.5f, 0.8f)}) {
    live.Apply({edit});
    fold.Note(edit, live);
    TopologyBuilder builder(scene);
    for (const TopologyEntry& entry : fold.Entries(live)) ASSERT_TRUE(builder.Add(entry).ok());
    ASSERT_TRUE(builder.Finish(live.revision()).ok());
    const Topology& late = builder.topology();
    EXPECT_EQ(late.hanging(), live.hanging());
    ASSERT_EQ(late.scene().parts.size(), live.scene().parts.size());
    EXPECT_EQ(late.BricksLeft().hanging().size(), live.BricksLeft().hanging().size());
  }
  EXPECT_EQ(live.BricksLeft().size(), live.BricksLeft().InBox(60, -120, 200, -60).size())
      << "only the low ones stand";
}

}  // namespace foundation_test
}  // namespace seam
