/// Outlines of polygons that touch, against shapes whose outline is known.

#include "common/physics/outline/solid_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "common/base/geometry.h"

namespace seam {
namespace solid_outline_test {

using Eigen::Vector2d;

constexpr double kGap = 5e-3;

SolidPolygon Box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 0};
}

/// m: the length of all edges.
double LengthOf(const std::vector<SolidOutline>& outlines) {
  double sum = 0;
  for (const SolidOutline& outline : outlines) {
    for (const OutlineEdge& edge : outline.edges) sum += (edge.to - edge.from).norm();
  }
  return sum;
}

/// Returns the edge through the point, of any outline; one without length if there is none.
OutlineEdge EdgeAt(const std::vector<SolidOutline>& outlines, const Vector2d& point) {
  for (const SolidOutline& outline : outlines) {
    for (const OutlineEdge& edge : outline.edges) {
      const Vector2d along = (edge.to - edge.from).normalized();
      const double at = along.dot(point - edge.from);
      const bool on = std::fabs(Cross(along, point - edge.from)) < 1e-6 && at > -1e-6 &&
                      at < (edge.to - edge.from).norm() + 1e-6;
      if (on) return edge;
    }
  }
  return {};
}

TEST(SolidOutline, PolygonsThatDoNotTouchStandAlone) {
  for (const SolidOutline& outline : OutlinesOf({Box(0, 0, 1, 1), Box(1.02, 0, 2, 1)}, kGap)) {
    EXPECT_TRUE(outline.alone);
  }
  EXPECT_TRUE(OutlinesOf({Box(0, 0, 1, 1)}, kGap)[0].alone);
  EXPECT_TRUE(OutlinesOf({}, kGap).empty());
}

TEST(SolidOutline, ARowHasTheOutlineOfOneBox) {
  for (const double apart : {0.0, 1e-4, 2e-3, -0.1}) {  // a gap, or an overlap
    std::vector<SolidPolygon> row;
    for (int i = 0; i < 5; ++i) row.push_back(Box(i, 0, i + 1 - apart, 1));
    const std::vector<SolidOutline> outlines = OutlinesOf(row, kGap);
    const double right = 5 - apart;
    const double twice = apart < 0 ? 2 * 4 * -apart : 0;  // both of two that overlap have the edge
    EXPECT_NEAR(LengthOf(outlines), 2 * (right + 1) + twice, 1e-2) << apart;
    // In the middle the top goes straight on at both ends, at the row's ends it turns.
    const OutlineEdge middle = EdgeAt(outlines, {2.5, 1});
    EXPECT_NEAR((middle.before - Vector2d(-1, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((middle.after - Vector2d(-1, 0)).norm(), 0, 1e-9);
    const OutlineEdge last = EdgeAt(outlines, {4.5, 1});
    EXPECT_NEAR((last.before - Vector2d(0, 1)).norm(), 0, 1e-9);
    EXPECT_NEAR((last.after - Vector2d(-1, 0)).norm(), 0, 1e-9);
  }
}

TEST(SolidOutline, EdgesOfAGapMeetInItsMiddle) {
  const std::vector<SolidOutline> outlines =
      OutlinesOf({Box(0, 0, 1, 1), Box(1.004, 0, 2, 1)}, kGap);
  EXPECT_NEAR(EdgeAt(outlines, {0.5, 1}).from.x(), 1.002, 1e-9);
  EXPECT_NEAR(EdgeAt(outlines, {1.5, 1}).to.x(), 1.002, 1e-9);
}

TEST(SolidOutline, AStepKnowsTheWallAboveIt) {
  const std::vector<SolidOutline> outlines = OutlinesOf({Box(0, 0, 1, 1), Box(1, 0, 2, 3)}, kGap);
  const OutlineEdge low = EdgeAt(outlines, {0.5, 1}), wall = EdgeAt(outlines, {1, 2});
  EXPECT_NEAR((low.before - Vector2d(0, -1)).norm(), 0, 1e-9);
  EXPECT_NEAR((wall.after - Vector2d(-1, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(wall.to.y(), 1, 2e-3) << "below it is hidden";
  EXPECT_NEAR(LengthOf(outlines), 2 + 3 + 1 + 2 + 1 + 1, 1e-2);
}

TEST(SolidOutline, StepsBelowTheRimAreNotSeen) {
  const std::vector<SolidOutline> low = OutlinesOf({Box(0, 0, 1, 1), Box(1, 0, 2, 1.004)}, kGap);
  EXPECT_NEAR((EdgeAt(low, {0.5, 1}).before - Vector2d(-1, 0)).norm(), 0, 1e-9);
  const std::vector<SolidOutline> high = OutlinesOf({Box(0, 0, 1, 1), Box(1, 0, 2, 1.05)}, kGap);
  EXPECT_NEAR((EdgeAt(high, {0.5, 1}).before - Vector2d(0, -1)).norm(), 0, 1e-9);
}

TEST(SolidOutline, AnEnclosedTileHasNoEdges) {
  std::vector<SolidPolygon> tiles;
  for (int i = 0; i < 9; ++i) tiles.push_back(Box(i % 3, i / 3, i % 3 + 1, i / 3 + 1));
  const std::vector<SolidOutline> outlines = OutlinesOf(tiles, kGap);
  EXPECT_FALSE(outlines[4].alone);
  EXPECT_TRUE(outlines[4].edges.empty());
  EXPECT_NEAR(LengthOf(outlines), 12, 1e-2);
}

TEST(SolidOutline, ASideIsHiddenOnlyByAPolygonThatCollidesWithTheSameBodies) {
  SolidPolygon ghost = Box(1, 0, 2, 1);
  ghost.group = -3;
  const std::vector<SolidOutline> apart = OutlinesOf({Box(0, 0, 1, 1), ghost}, kGap);
  EXPECT_TRUE(apart[0].alone);
  EXPECT_EQ(apart[1].edges.size(), 3u) << "all that meet the second meet the first";
  SolidPolygon like = Box(0, 0, 1, 1);
  like.group = -3;
  EXPECT_EQ(OutlinesOf({like, ghost}, kGap)[0].edges.size(), 3u);
}

TEST(SolidOutline, AHillOfTurnedBoxesBendsAtItsSeams) {
  // Boxes of 2 m by 1 m whose upper corners meet, each turned by 0.1 rad.
  std::vector<SolidPolygon> hill;
  Vector2d corner(0, 0);
  for (int i = 0; i < 6; ++i) {
    const double angle = 0.25 - 0.1 * i;
    const Vector2d along(std::cos(angle), std::sin(angle)), up(-along.y(), along.x());
    hill.push_back({{corner - up, corner + 2 * along - up, corner + 2 * along, corner}, 0});
    corner += 2 * along;
  }
  const std::vector<SolidOutline> outlines = OutlinesOf(hill, kGap);
  for (std::size_t i = 1; i + 1 < hill.size(); ++i) {
    const Vector2d middle = (hill[i].points[2] + hill[i].points[3]) / 2;
    const OutlineEdge top = EdgeAt(outlines, middle);
    // From the right to the left: the next box is turned by 0.1 rad to the left.
    const Vector2d along = (top.to - top.from).normalized();
    EXPECT_NEAR(Cross(along, top.after), std::sin(0.1), 1e-6) << i;
    EXPECT_NEAR(Cross(top.before, along), std::sin(0.1), 1e-6) << i;
  }
}

}  // namespace solid_outline_test
}  // namespace seam
