/// Nothing catches where segments meet, on either side.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/physics/outline/line_outline.h"
#include "tests/support/small_world.h"

namespace seam {
namespace line_contacts_test {

using Eigen::Vector2d;

/// Segments of 2 m from -20 m on, turned by `angle` about the origin. Every other one is the other
/// way round, if `mixed`.
std::string Segments(int count, double angle = 0, bool mixed = false) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    double from = -20 + 2 * i, to = from + 2;
    if (mixed && i % 2 == 1) std::swap(from, to);
    const auto at = [&](double x) {
      return "[" + FloatDigits(x * std::cos(angle)) + ", " + FloatDigits(x * std::sin(angle)) + "]";
    };
    text += "[[part]]\nname = \"s" + std::to_string(i) + "\"\nsegment = [" + at(from) + ", " +
            at(to) + "]\nfriction = 0\n";
  }
  return text;
}

std::string Thrown(const std::string& shape, double x, double y, double speed) {
  return "[[part]]\nname = \"b\"\n" + shape + "\nfriction = 0\nposition = [" + FloatDigits(x) +
         ", " + FloatDigits(y) + "]\nvelocity = [" + FloatDigits(speed) + ", " +
         (y > 0 ? "-3]\n" : "3]\n");
}

TEST(LineContacts, EverythingLandsOnARowOfSegmentsWithoutLoss) {
  for (const char* shape :
       {"circle = 0.5", "capsule = [0.8, 0.3]", "box = [1, 1]", "box = [0.4, 0.4]"}) {
    for (const bool mixed : {false, true}) {
      for (const bool above : {true, false}) {
        for (int i = 0; i < 20; ++i) {
          const double x = -15 + 0.173 * i, speed = 12 + 0.3 * i;
          const auto world =
              SmallWorld(Segments(80, 0, mixed) + Thrown(shape, x, above ? 3 : -3, speed), "",
                         above ? "" : "gravity = [0, 10]\n");
          Steps(world.get(), 240);
          const BodyState end = world->Read(0);
          EXPECT_NEAR(end.velocity.x(), speed, 1e-3 * speed) << shape << mixed << above << i;
          EXPECT_NEAR(end.angle, 0, 0.01) << shape;
          EXPECT_GT(above ? end.position.y() : -end.position.y(), 0.1f) << shape;
        }
      }
    }
  }
}

TEST(LineContacts, ABoxOnTheEndOfARowTipsOver) {
  const auto fallen = [](double x) {
    const auto world =
        SmallWorld(Segments(4) + "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [" +
                   FloatDigits(x) + ", 0.52]\n");
    Steps(world.get(), 120);
    return world->Read(0);
  };
  EXPECT_NEAR(fallen(-12.3).position.y(), 0.515f, 0.01f) << "its middle is on the row";
  EXPECT_LT(fallen(-11.8).position.y(), -2) << "its middle is beyond the end";
}

TEST(LineContacts, ABodyBesideAnEndIsNotLifted) {
  const std::string ground = "[[part]]\nname = \"g\"\nchain = [[-90, -0.5], [90, -0.5]]\n";
  const auto world = SmallWorld(ground + Segments(4) +
                                "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [-11.4, 0.02]\n");
  Steps(world.get(), 120);
  EXPECT_NEAR(world->Read(0).position.y(), 0.015f, 0.02f);
  EXPECT_NEAR(world->Read(0).position.x(), -11.4f, 0.1f);
}

TEST(LineContacts, ACornerStopsWhatRunsIntoIt) {
  const std::string wall = "[[part]]\nname = \"wall\"\nsegment = [[0, 0], [0, 4]]\n";
  for (const char* shape : {"circle = 0.5", "box = [1, 1]"}) {
    const auto world = SmallWorld(Segments(10) + wall + Thrown(shape, -8, 0.52, 8));
    Steps(world.get(), 240);
    EXPECT_LT(world->Read(0).position.x(), -0.4f) << shape;
    EXPECT_NEAR(world->Read(0).position.y(), 0.51f, 0.03f) << shape;
  }
}

TEST(LineContacts, ALineKnowsItsNextOnesOnBothSides) {
  const std::vector<SolidOutline> outlines =
      LineOutlinesOf({{{0, 0}, {2, 0}}, {{2, 0}, {4, 1}}, {{9, 0}, {10, 0}}}, 5e-3);
  ASSERT_EQ(outlines[0].edges.size(), 2u);
  const Vector2d up = Vector2d(2, 1).normalized();
  EXPECT_LT((outlines[0].edges[0].after - up).norm(), 1e-9);
  EXPECT_LT((outlines[0].edges[1].before + up).norm(), 1e-9);
  EXPECT_LT((outlines[0].edges[1].after - Vector2d(0, -1)).norm(), 1e-9) << "a free end";
  EXPECT_TRUE(outlines[2].alone);
}

}  // namespace line_contacts_test
}  // namespace seam
