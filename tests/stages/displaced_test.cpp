/// Areas cut out of shapes, against formulas and against each other.

#include "common/stages/water/displaced.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace displaced_test {

constexpr double kWide = 1e4;

/// All of the plane below `level`.
Bounds Below(double level) { return {{-kWide, -kWide}, {kWide, level}}; }
Bounds Above(double level) { return {{-kWide, level}, {kWide, kWide}}; }

std::vector<Vec2d> Turned(const std::vector<Vec2d>& points, double angle, const Vec2d& to) {
  std::vector<Vec2d> out;
  for (const Vec2d& p : points) {
    out.push_back(to + Vec2d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                             std::sin(angle) * p.x() + std::cos(angle) * p.y()));
  }
  return out;
}

AreaMoments Within(const std::vector<Vec2d>& points, const Bounds& bounds) {
  return AreaWithin(points.data(), static_cast<int>(points.size()), bounds);
}

void ExpectSame(const AreaMoments& a, const AreaMoments& b, double tolerance) {
  EXPECT_NEAR(a.area, b.area, tolerance);
  EXPECT_NEAR(a.centre.x(), b.centre.x(), tolerance);
  EXPECT_NEAR(a.centre.y(), b.centre.y(), tolerance);
  EXPECT_NEAR(a.second, b.second, tolerance);
}

const std::vector<Vec2d> kSquare = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

TEST(Displaced, AnUprightBoxDisplacesItsWidthTimesTheDraught) {
  const AreaMoments wet = Within({{-2, -1}, {2, -1}, {2, 1}, {-2, 1}}, Below(-0.4));
  EXPECT_NEAR(wet.area, 4 * 0.6, 1e-12);
  EXPECT_NEAR(wet.centre.y(), -0.7, 1e-12);
  EXPECT_NEAR(wet.second, 2.4 * (16 + 0.36) / 12, 1e-12);
}

TEST(Displaced, ASquareOnItsCornerDisplacesTheDepthSquared) {
  const std::vector<Vec2d> diamond = Turned(kSquare, 0.78539816339744831, {0, 0});
  const double low = -std::sqrt(0.5);
  const AreaMoments wet = Within(diamond, Below(low + 0.3));
  EXPECT_NEAR(wet.area, 0.09, 1e-12);
  EXPECT_NEAR(wet.centre.y(), low + 0.2, 1e-12);
}

TEST(Displaced, WetAndDryPartsAddUpToTheWhole) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vec2d> points =
        Turned({{-1, -0.4}, {0.7, -0.6}, {1.1, 0.2}, {0, 0.9}}, 7 * random.Uniform(),
               {3 * random.Uniform(), random.Uniform()});
    const AreaMoments whole = AreaOf(points.data(), 4);
    for (const bool disc : {false, true}) {
      const double level = 2 * random.Uniform() - 0.5;
      const AreaMoments all = disc ? DiscWithin({1, 0.3}, 0.8, Below(kWide)) : whole;
      AreaMoments sum =
          disc ? DiscWithin({1, 0.3}, 0.8, Below(level)) : Within(points, Below(level));
      Add(disc ? DiscWithin({1, 0.3}, 0.8, Above(level)) : Within(points, Above(level)), &sum);
      ExpectSame(sum, all, 1e-9);
    }
  }
}

TEST(Displaced, SegmentsOfDiscsAreThoseOfFinePolygons) {
  std::vector<Vec2d> fine;
  const int corners = kCutCornersMax;
  for (int i = 0; i < corners; ++i) {
    const double turn = 2 * M_PI * (i + 0.5) / corners;
    fine.emplace_back(0.2 + 1.5 * std::cos(turn), -1 + 1.5 * std::sin(turn));
  }
  for (const double level : {-2.2, -1.5, -1.0, -0.4, 0.3}) {
    const AreaMoments exact = DiscWithin({0.2, -1}, 1.5, Below(level));
    ExpectSame(exact, Within(fine, Below(level)), 0.004 * 1.5 * 1.5 * M_PI);
  }
  // Half a disc: pi r^2 / 2, centre 4 r / (3 pi) below.
  const AreaMoments half = DiscWithin({0, 0}, 2, Below(0));
  EXPECT_NEAR(half.area, 2 * M_PI, 1e-12);
  EXPECT_NEAR(half.centre.y(), -8 / (3 * M_PI), 1e-12);
}

TEST(Displaced, FourWatersThatMeetInADiscShareItAll) {
  AreaMoments sum;
  for (const double x : {0.0, -kWide}) {
    for (const double y : {0.0, -kWide}) {
      Add(DiscWithin({0.2, -0.1}, 1, {{x, y}, {x + kWide, y + kWide}}), &sum);
    }
  }
  ExpectSame(sum, DiscWithin({0.2, -0.1}, 1, Below(kWide)), 5e-3);
  EXPECT_NEAR(sum.area, M_PI, 1e-9);
}

}  // namespace displaced_test
}  // namespace seam
