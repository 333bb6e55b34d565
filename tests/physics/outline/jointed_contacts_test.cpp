/// Nothing catches between the jointed bodies of a moving deck.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/small_world.h"

namespace seam {
namespace jointed_contacts_test {

/// Planks of 2 m whose top is at 0, heavy and without weight, each joined to the next by `joint`.
std::string Deck(const std::string& joint) {
  std::string text =
      "[[part]]\nname = \"p\"\nbox = [2, 1]\nposition = [-39, -0.5]\ndensity = 50\n"
      "friction = 0\ngravity_scale = 0\nrepeat = {count = 40, step = [2, 0]}\n";
  for (int i = 0; i + 1 < 40; ++i) {
    text += "[[joint]]\nname = \"j" + std::to_string(i) + "\"\na = \"p." + std::to_string(i) +
            "\"\nb = \"p." + std::to_string(i + 1) + "\"\n" + joint + "\n";
  }
  return text;
}

void ExpectKept(const std::string& deck, const std::string& shape, const std::string& solver) {
  for (int i = 0; i < 12; ++i) {
    const double speed = (i % 2 == 0 ? 1 : -1) * (9 + 1.1 * i);
    const auto world = SmallWorld(deck + "[[part]]\nname = \"b\"\nfriction = 0\n" + shape +
                                      "\nposition = [" + FloatDigits(-speed / 2 + 0.173 * i) +
                                      ", 2]\nvelocity = [" + FloatDigits(speed) + ", -3]\n",
                                  solver, "size_max = 100\n");
    Steps(world.get(), 120);
    const BodyState end = world->Read(world->body_count() - 1);
    EXPECT_NEAR(end.velocity.x(), speed, 1e-3 * std::fabs(speed)) << shape << solver << i;
    EXPECT_NEAR(end.angle, 0, 0.01) << shape << solver << i;
  }
}

TEST(JointedContacts, ThingsLandOnADeckOfJointedPlanksWithoutLoss) {
  const std::string slides = "kind = \"prismatic\"\naxis = [0, 1]\nlimits = [0, 0]";
  for (const char* shape : {"box = [1, 1]", "circle = 0.5", "capsule = [0.8, 0.3]"}) {
    ExpectKept(Deck(slides), shape, "");
    ExpectKept(Deck(slides), shape, "substeps = 3\n");
  }
}

TEST(JointedContacts, AGapBetweenPlanksCatches) {
  // A disc falls into the gap between two hinged planks, and stays there.
  const std::string planks =
      "[[part]]\nname = \"p\"\nbox = [2, 0.4]\nposition = [-1.4, 0]\nrepeat = {count = 2, step = "
      "[2.8, 0]}\n"
      "[[part]]\nname = \"post\"\nbox = [0.4, 3]\nposition = [-2.2, -1.71]\nanchored = true\n"
      "repeat = {count = 2, step = [4.4, 0]}\n"
      "[[part]]\nname = \"rail\"\nbox = [0.4, 3]\nposition = [-0.6, -1.71]\nanchored = true\n"
      "repeat = {count = 2, step = [1.2, 0]}\n"
      "[[joint]]\nname = \"rope\"\nkind = \"rope\"\na = \"p.0\"\nb = \"p.1\"\n"
      "[[part]]\nname = \"disc\"\ncircle = 0.45\nposition = [0, 1]\n";
  const auto world = SmallWorld(planks);
  Steps(world.get(), 180);
  const BodyState disc = world->Read(2);
  EXPECT_LT(disc.position.y(), 0.6f);
  EXPECT_GT(disc.position.y(), 0.1f);
  EXPECT_LT(disc.velocity.norm(), 0.05f);
}

}  // namespace jointed_contacts_test
}  // namespace seam
