/// Bricks that a blast leaves without a foundation fall, and nothing else.

#include "common/topology/feather_fall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/physics/world.h"
#include "common/scene/mass.h"
#include "common/topology/topology.h"

namespace seam {
namespace feather_fall_test {

const std::string kGround = "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n";

std::string Bricks(const std::string& name, float x, float y, int columns, int rows,
                   const std::string& more = "") {
  return "[[bricks]]\nname = \"" + name + "\"\nbrick = [0.4, 0.2]\nposition = [" +
         std::to_string(x) + ", " + std::to_string(y) + "]\ncount = [" + std::to_string(columns) +
         ", " + std::to_string(rows) + "]\n" + more;
}

/// Two walls and a roof on them: 4 m wide, 3 m high.
const std::string kHut = kGround + Bricks("left", 0, 0, 1, 14) + Bricks("right", 3.6f, 0, 1, 14) +
                         Bricks("roof", 0, 2.8f, 10, 1, "strength = 100\n");

Edit At(float x, float y, float radius, float speed = 20) {
  return Edit(BlastEdit{{x, y}, radius, speed});
}

int PartsOf(const Scene& scene, const std::string& bricks) {
  return static_cast<int>(
      std::count_if(scene.parts.begin(), scene.parts.end(),
                    [&](const Part& part) { return part.name.rfind(bricks + "@", 0) == 0; }));
}

TEST(FallingBricks, ARoofStaysOnOneWallAndComesDownWithTheSecond) {
  Topology topology(ParseScene(kHut, "hut.toml"));
  topology.Apply({At(0.2f, 1, 0.5f)});
  EXPECT_GT(PartsOf(topology.scene(), "left"), 0) << "the blast's, and what hung above it";
  EXPECT_EQ(PartsOf(topology.scene(), "roof"), 0) << "the right wall carries it";
  topology.Apply({At(3.8f, 1, 0.5f)});
  EXPECT_GT(PartsOf(topology.scene(), "roof"), 0);
  const FeatherStore& left = topology.BricksLeft();
  for (const Brick& b : left.InBox(-1000, -1000, 1000, 1000)) {
    EXPECT_LT(b.y, 20) << "below 1 m both walls stand";
    EXPECT_LT(b.kind, 2);
  }
  EXPECT_GT(left.size(), 0u);
  EXPECT_FALSE(topology.hanging().has_value());
}

TEST(FallingBricks, BricksThatBeginInTheAirStay) {
  Topology topology(ParseScene(kGround + Bricks("cloud", 0, 5, 10, 4), "cloud.toml"));
  topology.Apply({At(4, 5.8f, 0.5f)});
  EXPECT_EQ(PartsOf(topology.scene(), "cloud"), 1) << "only what the blast frees";
}

TEST(FallingBricks, AnEdgeSupportsAndACornerDoesNot) {
  const std::string low = Bricks("low", 0, 0, 1, 5);
  for (const auto& [x, falls] : {std::pair{0.4f, true}, std::pair{0.35f, false}}) {
    // The tower over the lower one touches it by a corner, or by 5 cm of an edge; and a post.
    const std::string text =
        kGround + low + Bricks("high", x, 1, 1, 3) + Bricks("post", x + 0.4f, 0, 1, 8);
    Topology topology(ParseScene(text, "corner.toml"));
    topology.Apply({At(x + 0.6f, 0.9f, 0.4f)});
    ASSERT_GT(PartsOf(topology.scene(), "post"), 0);
    EXPECT_EQ(PartsOf(topology.scene(), "high") > 0, falls) << x;
  }
}

TEST(FallingBricks, PiecesCoverFallingBricksOnceWithTheirMass) {
  const Scene scene = ParseScene(kGround + Bricks("tower", 0, 0, 9, 30, "density = 2\n"), "t.toml");
  Topology topology(scene);
  // Right through the tower, 3.6 m wide, in two blasts.
  topology.Apply({At(0.8f, 1, 1.15f), At(2.8f, 1, 1.2f)});
  const std::size_t left = topology.BricksLeft().size();
  EXPECT_LT(left, 9u * 12) << "only stumps stand";
  double mass = 0;
  for (const Part& part : topology.scene().parts) {
    if (part.name[0] == 't') mass += PartProperties(part).mass;
  }
  EXPECT_NEAR(mass, static_cast<double>(9 * 30 - left) * 0.4 * 0.2 * 2, 1e-3);
  EXPECT_EQ(FreedBricks(topology.scene().bricks, topology.scene().parts).size(), 270 - left);
  EXPECT_LE(topology.scene().parts.size(), 1u + 2 * kBlastPiecesMax + 2 * kFallPiecesMax);
}

TEST(FallingBricks, BricksBeyondOneEditFallByTheNext) {
  // Crosses of narrow bricks make many pieces: columns of every second one hang on one beam.
  std::string text = kGround + Bricks("post", 0, 0, 1, 10) + Bricks("beam", 0, 2, 125, 1);
  for (int i = 0; i < 60; ++i) {
    text += Bricks("c" + std::to_string(i), 0.8f * static_cast<float>(i), 2.2f, 1, 20);
  }
  Topology topology(ParseScene(text, "comb.toml"));
  topology.Apply({At(0.2f, 1, 0.5f)});
  int edits = 1;
  while (topology.hanging().has_value() && edits < 20) {
    const Vec2 there = *topology.hanging();
    topology.Apply({Edit(BlastEdit{there, 0.5f, 0, 0})});
    ++edits;
  }
  EXPECT_GT(edits, 1);
  EXPECT_LT(edits, 8);
  const FeatherStore& left = topology.BricksLeft();
  EXPECT_LT(left.size(), 10u) << "the stump of the post";
}

TEST(FallingBricks, TheSameEditsMakeTheSamePartsAndTheyComeToRestBelow) {
  World one(ParseScene(kHut, "hut.toml")), two(ParseScene(kHut, "hut.toml"));
  for (int t = 0; t < 600; ++t) {
    for (World* world : {&one, &two}) {
      if (t == 5) world->Apply({At(0.2f, 0.9f, 1.3f)});
      if (t == 6) world->Apply({At(3.8f, 0.9f, 1.3f)});
      world->Step();
    }
    if (t == 100) {
      EXPECT_TRUE(two.Restore(two.Barrier()).ok());
      one.Barrier();
    }
    ASSERT_EQ(one.Hash(), two.Hash()) << t;
  }
  ASSERT_GT(one.body_count(), 4);
  for (int body = 0; body < one.body_count(); ++body) {
    EXPECT_LT(one.Bounds(body).second.y(), 1.8f) << one.id(body) << " of a hut of 3 m";
    EXPECT_GT(one.Bounds(body).first.y(), -0.05f);
  }
}

TEST(FallingBricks, AFreedPieceDropsOutOfItsHole) {
  // A brick in the ceiling between two others: freed without a speed to speak of, it drops.
  World world(ParseScene(kGround + Bricks("ceiling", -2, 2, 10, 1), "hole.toml"));
  world.Apply({At(0.2f, 2.1f, 0.1f, 0.01f)});
  ASSERT_EQ(world.body_count(), 1);
  for (int t = 0; t < 90; ++t) world.Step();
  EXPECT_LT(world.Read(0).position.y(), 0.2f);
}

}  // namespace feather_fall_test
}  // namespace seam
