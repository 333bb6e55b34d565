#include "tests/lab/exact/displacement.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// The shape is the hull of these points, m, with a rim of `radius` around it.
struct Hull {
  std::vector<Eigen::Vector2d> points;
  double radius = 0;
};

Hull HullOf(const Part& part) {
  Hull hull;
  const bool round = part.kind == ShapeKind::kCircle || part.kind == ShapeKind::kCapsule;
  if (round) hull.radius = static_cast<double>(part.radius);
  for (const Vec2& point : part.points) hull.points.push_back(point.cast<double>());
  if (part.kind == ShapeKind::kBox) {
    const Eigen::Vector2d half = part.size.cast<double>() / 2;
    for (const double x : {-half.x(), half.x()}) {
      for (const double y : {-half.y(), half.y()}) hull.points.push_back({x, y});
    }
  }
  if (hull.points.empty()) hull.points.push_back({0, 0});
  return hull;
}

}  // namespace

double Displacement(const Part& part, const BodyState& state, const WantedPose& wanted) {
  const Eigen::Vector2d at = state.position.cast<double>();
  const double angle = static_cast<double>(state.angle);
  const Eigen::Vector2d shift(wanted.x ? at.x() - *wanted.x : 0, wanted.y ? at.y() - *wanted.y : 0);
  if (!wanted.angle) return shift.norm();
  const Rotation<double> is(angle), should(*wanted.angle);
  const double turn = WrapAngle(angle - *wanted.angle);
  // Between two poses a point moves by an affine function of where it is on the shape, whose norm
  // is convex: the corners move farthest. A rim turns about its corner, and some point of it moves
  // in the corner's own direction.
  const Hull hull = HullOf(part);
  double farthest = 0;
  for (const Eigen::Vector2d& point : hull.points) {
    const double moved = (shift + is(point) - should(point)).norm();
    farthest = std::isnan(moved) || moved > farthest ? moved : farthest;
  }
  return farthest + 2 * std::fabs(std::sin(turn / 2)) * hull.radius;
}

}  // namespace seam
