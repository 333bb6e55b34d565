/// Grouping of bodies at rest.

#include <gtest/gtest.h>

#include "common/physics/part_places.h"
#include "tests/support/living_world.h"

namespace seam {
namespace group_test {

const char* const kGround = "[[part]]\nname = \"ground\"\nchain = [[-20, 0], [20, 0]]\n";

std::string Stack(const std::string& more = "") {
  return std::string("[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0.515]\n") + more +
         "\nrepeat = {count = 3, step = [0, 1.015]}\n";
}

const char* const kGrouping = "[grouping]\nafter = 0.5\n";

TEST(Group, AStackAtRestBecomesOneBody) {
  auto world = SmallWorld(std::string(kGround) + Stack() + kGrouping);
  Live(world.get(), 20);
  EXPECT_EQ(world->body_count(), 3);
  const std::vector<Edit> edits = Live(world.get(), 100);
  EXPECT_EQ(edits.size(), 2u);
  ASSERT_EQ(world->body_count(), 1);
  const Vec2 before = world->Read(0).position;
  EXPECT_TRUE(Live(world.get(), 60).empty());
  EXPECT_NEAR((world->Read(0).position - before).norm(), 0, 2e-3);
}

TEST(Group, AnImpactMeetsSingleBodies) {
  const std::string ball =
      "[[part]]\nname = \"ball\"\ncircle = 0.3\nposition = [-20, 2.5]\n"
      "velocity = [9.5, 10]\ndensity = 4\n";
  auto grouped = SmallWorld(std::string(kGround) + Stack() + ball + kGrouping);
  auto single = SmallWorld(std::string(kGround) + Stack() + ball);
  auto welded = SmallWorld(std::string(kGround) + Stack() + ball +
                           "[[joint]]\nname = \"w\"\nkind = \"weld\"\na = \"box.0\"\n"
                           "b = \"box.1\"\n[[joint]]\nname = \"v\"\nkind = \"weld\"\n"
                           "a = \"box.1\"\nb = \"box.2\"\n");
  single->Barrier();  // an edit puts contacts in order as a barrier does
  Live(grouped.get(), 100);
  EXPECT_EQ(grouped->body_count(), 2);
  Live(grouped.get(), 150);
  Live(single.get(), 250);
  Live(welded.get(), 250);
  // The blow met the box that it hits, not the weight of three.
  for (const PartId box : {1, 2, 3}) {
    const Vec2 at = PartPose(*single, box).position;
    const float apart = (PartPose(*grouped, box).position - at).norm();
    const float if_one = (PartPose(*welded, box).position - at).norm();
    EXPECT_LT(apart, if_one / 3) << box;
  }
  EXPECT_GT(single->Read(single->BodyOfId(3)).position.x(), 0.5f) << "it was hit";
}

TEST(Group, MechanismsAndAnchoredBodiesAreNotGrouped) {
  const std::string hinged =
      "[[part]]\nname = \"arm\"\nbox = [1, 1]\nposition = [4, 0.515]\n"
      "[[part]]\nname = \"hand\"\nbox = [1, 1]\nposition = [5.02, 0.515]\n"
      "[[joint]]\nname = \"elbow\"\nkind = \"revolute\"\na = \"arm\"\nb = \"hand\"\n"
      "anchor = [4.5, 0.515]\ncollide = true\n"
      "[[part]]\nname = \"kerb\"\nbox = [1, 1]\nposition = [6.03, 0.5]\nanchored = true\n";
  auto world = SmallWorld(std::string(kGround) + hinged + kGrouping);
  EXPECT_TRUE(Live(world.get(), 120).empty());
}

}  // namespace group_test
}  // namespace seam
