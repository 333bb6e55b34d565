#include "common/stages/water/water_push.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/scene/water.h"

namespace seam {
namespace {

bool Apart(const Vec2d& centre, double reach, const Bounds& b) {
  return centre.x() + reach <= b.min.x() || centre.x() - reach >= b.max.x() ||
         centre.y() + reach <= b.min.y() || centre.y() - reach >= b.max.y();
}

bool Inside(const Vec2d& centre, double reach, const Bounds& b) {
  return centre.x() - reach >= b.min.x() && centre.x() + reach <= b.max.x() &&
         centre.y() - reach >= b.min.y() && centre.y() + reach <= b.max.y();
}

AreaMoments DisplacedExactly(const WetPart& part, const FloatingBody& body, const Bounds& water) {
  const Vec2d centre = body.ToWorld(part.whole.centre);
  if (Apart(centre, part.reach, water)) return {};
  if (Inside(centre, part.reach, water)) return {part.whole.area, centre, part.whole.second};
  if (part.disc) return DiscWithin(centre, part.radius, water);
  Vec2d corners[kCutCornersMax];
  const int count = static_cast<int>(part.corners.size());
  for (int i = 0; i < count; ++i) {
    corners[i] = body.ToWorld(part.corners[static_cast<std::size_t>(i)]);
  }
  return AreaWithin(corners, count, water);
}

/// Each cell is submerged by the share of its height below the level.
AreaMoments DisplacedByCells(const WetCells& cells, const FloatingBody& body, const Bounds& water) {
  const double height = std::fabs(body.rotation.sine) * cells.size.x() +
                        std::fabs(body.rotation.cosine) * cells.size.y();
  AreaMoments sum;
  for (const AreaMoments& piece : cells.pieces) {
    const Vec2d centre = body.ToWorld(piece.centre);
    const bool beside = centre.x() < water.min.x() || centre.x() > water.max.x();
    if (beside || centre.y() < water.min.y()) continue;
    const double share = std::clamp((water.max.y() - centre.y()) / height + 0.5, 0.0, 1.0);
    Add({share * piece.area, centre, share * piece.second}, &sum);
  }
  return sum;
}

}  // namespace

Bounds BoundsOf(const Water& water) { return {water.min.cast<double>(), water.max.cast<double>()}; }

AreaMoments Displaced(const WetShape& shape, const WetCells* cells, const FloatingBody& body,
                      const Bounds& water) {
  if (cells != nullptr) return DisplacedByCells(*cells, body, water);
  AreaMoments sum;
  for (const WetPart& part : shape.parts) Add(DisplacedExactly(part, body, water), &sum);
  return sum;
}

Vec2d WaterSum::Relative(const Vec2d& arm, const Water& water) const {
  return body_.velocity + body_.spin * Vec2d(-arm.y(), arm.x()) - water.flow.cast<double>();
}

void WaterSum::AddLinear(const Eigen::Vector3d& row, double speed, double factor) {
  drag_ -= factor * speed * row;
  slope_ += factor * row * row.transpose();
}

/// Adds factor * |speed| speed against `way` at `arm`.
void WaterSum::Resist(const Vec2d& arm, const Vec2d& way, double speed, double factor) {
  const Eigen::Vector3d row(way.x(), way.y(), Cross(arm, way));
  const double strength = factor * std::fabs(speed);
  drag_ -= strength * speed * row;
  slope_ += 2 * strength * row * row.transpose();
}

void WaterSum::AddEdge(const WetEdge& edge, const Bounds& bounds, const Water& water) {
  Vec2d from = body_.ToWorld(edge.from), to = body_.ToWorld(edge.to);
  if (!Shorten(bounds, &from, &to)) return;
  const Vec2d normal = body_.rotation(edge.normal), along(-normal.y(), normal.x());
  const Vec2d middle = (from + to) / 2 - body_.centre, half = (to - from) / 2;
  const double length = 2 * half.norm(), rho = static_cast<double>(water.density) / 2;

  // Along a straight edge of a rigid body the tangential speed is constant,
  const double slip = Relative(middle, water).dot(along);
  Resist(middle, along, slip, rho * static_cast<double>(water.drag_tangent) * length);

  // and the normal speed is linear: s in -1..1 from `from` to `to`, positive between a and b.
  const double speed = Relative(middle, water).dot(normal);
  const double change = edge.arc ? 0 : body_.spin * Cross(half, normal);
  double a = -1, b = 1;
  if (std::fabs(change) > std::fabs(speed)) {
    (change > 0 ? a : b) = -speed / change;
  } else if (speed <= 0) {
    return;
  }
  // Gauss's two points integrate the force (second degree) and its torque (third) exactly.
  const double factor = rho * static_cast<double>(water.drag_normal) * length * (b - a) / 4;
  for (const double sign : {-1.0, 1.0}) {
    const double s = (a + b) / 2 + sign * (b - a) / 2 * 0.57735026918962576;
    Resist(middle + s * half, normal, speed + s * change, factor);
  }
}

void WaterSum::Add(const WetShape& shape, const WetCells* cells, const Water& water) {
  const Bounds bounds = BoundsOf(water);
  if (Apart(body_.ToWorld(shape.centre), shape.reach, bounds)) return;
  const AreaMoments wet = Displaced(shape, cells, body_, bounds);
  if (wet.area <= 0) return;
  empty_ = false;
  const Vec2d arm = wet.centre - body_.centre;
  const Vec2d lift = -static_cast<double>(water.density) * wet.area * gravity_;
  lift_.force += lift;
  lift_.torque += Cross(arm, lift);

  const double thick = static_cast<double>(water.viscosity);
  const Vec2d u = Relative(arm, water);
  AddLinear({1, 0, -arm.y()}, u.x(), thick * wet.area);
  AddLinear({0, 1, arm.x()}, u.y(), thick * wet.area);
  AddLinear({0, 0, 1}, body_.spin, thick * wet.second);
  if (water.drag_normal <= 0 && water.drag_tangent <= 0) return;
  for (const WetEdge& edge : shape.edges) AddEdge(edge, bounds, water);
}

Push WaterSum::Over(double h) const {
  Push push = lift_;
  if (slope_.isZero(0)) return push;
  const Eigen::Vector3d masses(body_.mass, body_.mass, body_.inertia);
  const Vec2d others = lift_.force + body_.mass * gravity_;
  const Eigen::Vector3d pushed =
      h * (drag_ + Eigen::Vector3d(others.x(), others.y(), lift_.torque));
  Eigen::Matrix3d heavy = h * slope_;
  heavy.diagonal() += masses;
  const Eigen::Vector3d change = heavy.llt().solve(pushed);
  // The drag's share of the step's force: drag - K dv, which avoids the difference of large
  // numbers.
  const Eigen::Vector3d drag = drag_ - slope_ * change;
  push.force += Vec2d(drag.x(), drag.y());
  push.torque += drag.z();
  return push;
}

}  // namespace seam
