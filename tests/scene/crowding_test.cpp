/// Scenes with too many overlapping parts in one place are refused by place and number; others are
/// not.

#include "common/scene/crowding/crowding.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "common/base/check.h"
#include "common/physics/world.h"
#include "common/scene/scene_limits.h"
#include "common/topology/topology.h"

namespace seam {
namespace crowding_test {

/// A floor, and on line 5 boxes of `side` m: `columns` times `rows`, `step` m apart.
std::string Boxes(int columns, int rows, double step, const std::string& more = "",
                  double side = 0.5) {
  const std::string size = std::to_string(side), apart = std::to_string(step);
  return "[[part]]\nname = \"floor\"\nbox = [100, 1]\nanchored = true\n"
         "[[part]]\nname = \"box\"\nposition = [3, 5]\nbox = [" +
         size + ", " + size + "]\n" + more + "repeat = {count = [" + std::to_string(columns) +
         ", " + std::to_string(rows) + "], step = [" + apart + ", " + apart + "]}\n";
}

std::string Complaint(const std::string& text) {
  try {
    ParseScene(text, "s.toml");
    return "";
  } catch (const OperatorError& e) {
    return e.what();
  }
}

Crowding CrowdingIn(const std::string& text) {
  const Scene scene = ParseScene(text, "s.toml");
  return CrowdingOf(scene, Compose(scene));
}

TEST(Crowding, APileAtOnePointIsRefusedByPlaceAndNumber) {
  EXPECT_EQ(Complaint(Boxes(4000, 1, 0)),
            "s.toml:5: part 'box.0.0': too much begins in one place, most of it around [3, 5]: "
            "7998000 pairs of shapes overlap, of at most 50000");
  EXPECT_NE(Complaint(Boxes(50, 40, 0.04)).find("460668 pairs"), std::string::npos);
  EXPECT_NE(Complaint(Boxes(300, 1, 0, "bullet = true\n")).find("44850 pairs of shapes with a"),
            std::string::npos);
}

TEST(Crowding, CountsPairsOfOverlappingShapes) {
  EXPECT_EQ(CrowdingIn(Boxes(100, 1, 0)).pairs, 4950);
  EXPECT_EQ(CrowdingIn(Boxes(7, 7, 0.25)).pairs, 2 * 42 + 2 * 36) << "the eight next to each";
  EXPECT_EQ(CrowdingIn(Boxes(20, 20, 0.5)).pairs, 0) << "they touch";
  EXPECT_EQ(CrowdingIn(Boxes(40, 1, 0, "bullet = true\n")).bullet_pairs, 780);
  EXPECT_EQ(CrowdingIn(Boxes(40, 1, 0, "group = -1\n")).pairs, 0) << "they do not collide";
  EXPECT_EQ(CrowdingIn(Boxes(40, 1, 0, "anchored = true\n")).pairs, 0) << "nothing moves";
}

TEST(Crowding, WeldedAndJointedPairsDoNotCount) {
  std::string welded = Boxes(40, 1, 0);
  welded.insert(welded.rfind('}'), ", weld = true");
  EXPECT_EQ(CrowdingIn(welded).pairs, 0);
  const std::string joint =
      "[[joint]]\nname = \"j\"\nkind = \"revolute\"\na = \"box.0.0\"\nb = \"box.1.0\"\n"
      "anchor = [3, 5]\n";
  EXPECT_EQ(CrowdingIn(Boxes(40, 1, 0) + joint).pairs, 779);
  EXPECT_EQ(CrowdingIn(Boxes(40, 1, 0) + joint + "collide = true\n").pairs, 780);
}

TEST(Crowding, AShapeOfSeveralFixturesCountsEachFixture) {
  const auto many = [](const std::string& shape) {
    return "[[part]]\nname = \"a\"\n" + shape + "\nrepeat = {count = 10, step = [0, 0]}\n";
  };
  EXPECT_EQ(CrowdingIn(many("circle = 1")).pairs, 45);
  EXPECT_EQ(CrowdingIn(many("capsule = [2, 0.5]")).pairs, 45 * 9);
  const std::string chain =
      "[[part]]\nname = \"hills\"\nchain = [[-9, 0], [-2, 0.4], [0, 0], [2, 0.4], [9, 0]]\n"
      "[[part]]\nname = \"a\"\nbox = [1, 1]\n";
  EXPECT_EQ(CrowdingIn(chain).pairs, 2) << "the two segments that meet under the box";
}

TEST(Crowding, NoSceneOfTheProjectIsNearTheLimit) {
  for (const char* folder : {"scenes", "scenes/hard"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      const Scene scene = LoadScene(entry.path().string());
      const Crowding crowding = CrowdingOf(scene, Compose(scene));
      EXPECT_LT(crowding.pairs, kCrowdMax / 10) << entry.path();
      EXPECT_LT(crowding.bullet_pairs, kBulletCrowdMax / 10) << entry.path();
    }
  }
}

TEST(Crowding, AStepAtTheLimitEndsAndLeavesEveryBodyFinite) {
  for (const std::string& text :
       {Boxes(310, 1, 0), Boxes(80, 50, 0.17), Boxes(16, 16, 0.1, "bullet = true\n", 0.2),
        Boxes(44, 1, 0, "bullet = true\n", 0.2)}) {
    World world(ParseScene(text, "s.toml"));
    const auto begin = std::chrono::steady_clock::now();
    world.Step();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::printf("[          ] %d bodies: %.3f s\n", world.body_count(), took.count());
    for (int body = 0; body < world.body_count(); ++body) {
      EXPECT_TRUE(world.Read(body).position.allFinite()) << body;
    }
  }
}

TEST(Crowding, InsertedPartsObeyTheSameLimits) {
  Scene scene = ParseScene(Boxes(20, 20, 0.5), "s.toml");
  const std::string one = "[[part]]\nname = \"late\"\nbox = [0.5, 0.5]\nposition = [-9, 5]\n";
  const std::string pile = one + "repeat = {count = 400, step = [0, 0]}\n";
  const std::size_t parts = scene.parts.size();
  try {
    AddToScene(pile, &scene);
    ADD_FAILURE() << "not refused";
  } catch (const OperatorError& e) {
    EXPECT_EQ(std::string(e.what()),
              "insert:1: part 'late.0': too much begins in one place, most of it around [-9, 5]: "
              "79800 pairs of shapes overlap, of at most 50000");
  }
  EXPECT_EQ(scene.parts.size(), parts);
  AddToScene(one, &scene);
  EXPECT_EQ(scene.parts.size(), parts + 1);
  // A gun: each comes where the others came from, and those have left.
  for (int shot = 0; shot < 1500; ++shot) {
    AddToScene("[[part]]\nname = \"shot" + std::to_string(shot) +
                   "\"\ncircle = 0.1\nbullet = true\nposition = [-5, 5]\n",
               &scene);
  }
}

}  // namespace crowding_test
}  // namespace seam
