/// The displacement of a part from its exact pose, over the points of its shape, against geometry
/// by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "tests/lab/exact/displacement.h"

namespace seam {
namespace lab_exact_displacement_test {

Part PartOf(const std::string& shape) {
  return ParseScene("[[part]]\nname = \"a\"\nposition = [5, 5]\n" + shape + "\n", "made-up.toml")
      .parts[0];
}

WantedPose Wanted(double x, double y, double angle) { return {x, y, angle}; }

BodyState At(float x, float y, float angle) { return {{x, y}, angle, {0, 0}, 0}; }

TEST(Displacement, EqualsTheDistanceWithoutATurn) {
  for (const char* shape : {"box = [2, 1]", "circle = 0.5", "polygon = [[0, 0], [2, 0], [0, 1]]"}) {
    EXPECT_NEAR(Displacement(PartOf(shape), At(3, 4, 1), Wanted(0, 0, 1)), 5, 1e-6) << shape;
  }
}

TEST(Displacement, ATurnDisplacesTheFarthestPoint) {
  const double turn = 0.2, chord = 2 * std::sin(turn / 2);
  const auto turned = [&](const char* shape) {
    return Displacement(PartOf(shape), At(0, 0, 0.2f), Wanted(0, 0, 0));
  };
  EXPECT_NEAR(turned("box = [2, 1]"), chord * std::hypot(1, 0.5), 1e-6);
  EXPECT_NEAR(turned("circle = 0.5"), chord * 0.5, 1e-6);
  EXPECT_NEAR(turned("capsule = [2, 0.25]"), chord * 1.25, 1e-6);
  EXPECT_NEAR(Displacement(PartOf("circle = 0.5"), At(3, 4, 0.2f), Wanted(0, 0, 0)),
              5 + chord * 0.5, 1e-6)
      << "some point of the rim moves as the centre does";
  EXPECT_NEAR(Displacement(PartOf("circle = 0.5"), At(0, 0, 0), Wanted(0, 0, 2 * kPi)), 0, 1e-12)
      << "whole turns do not matter";
}

TEST(Displacement, AnUnspecifiedCoordinateCountsAsRight) {
  const Part box = PartOf("box = [2, 1]");
  EXPECT_NEAR(Displacement(box, At(3, 4, 1), {3.0, {}, {}}), 0, 1e-6);
  EXPECT_NEAR(Displacement(box, At(3, 4, 1), {{}, 0.0, {}}), 4, 1e-6);
  EXPECT_NEAR(Displacement(box, At(3, 4, 1), {0.0, 0.0, {}}), 5, 1e-6);
  EXPECT_GT(Displacement(box, At(3, 4, 1), {{}, {}, 0.0}), 0.5);
}

TEST(Displacement, ANanStateGivesNan) {
  const Part box = PartOf("box = [2, 1]");
  EXPECT_TRUE(std::isnan(Displacement(box, At(NAN, 0, 0), Wanted(0, 0, 0))));
  EXPECT_TRUE(std::isnan(Displacement(box, At(0, 0, NAN), Wanted(0, 0, 0))));
}

}  // namespace lab_exact_displacement_test
}  // namespace seam
