#include "common/topology/floors.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

using Eigen::Vector2d;

std::int64_t Millimetres(double metres) { return std::llround(metres * 1000); }

/// Adds the line between `a` and `b`, in either order.
void AddLine(const Vector2d& a, const Vector2d& b, std::vector<Floor>* floors) {
  const Vector2d &left = a.x() < b.x() ? a : b, &right = a.x() < b.x() ? b : a;
  const Floor floor{Millimetres(left.x()), Millimetres(left.y()), Millimetres(right.x()),
                    Millimetres(right.y()), 0};
  if (floor.x0 < floor.x1) floors->push_back(floor);
}

void AddCircle(const Vector2d& centre, double radius, std::vector<Floor>* floors) {
  const std::int64_t x = Millimetres(centre.x()), y = Millimetres(centre.y());
  const std::int64_t r = Millimetres(radius);
  if (r > 0) floors->push_back({x - r, y, x + r, y, r});
}

void AddPolygon(const std::vector<Vector2d>& points, std::vector<Floor>* floors) {
  double area = 0;  // twice it; positive counter-clockwise
  for (std::size_t i = 0; i < points.size(); ++i) {
    area += Cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d &a = points[i], &b = points[(i + 1) % points.size()];
    if ((b.x() - a.x()) * area < 0) AddLine(a, b, floors);  // the inside is below
  }
}

}  // namespace

Floor::Heights Floor::Between(std::int64_t from, std::int64_t to) const {
  const std::int64_t middle = (x0 + x1) / 2;
  const auto height = [&](std::int64_t x) -> std::int64_t {
    if (radius == 0) return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    const std::int64_t square = radius * radius - (x - middle) * (x - middle);
    return y0 + std::llround(std::sqrt(static_cast<double>(std::max<std::int64_t>(square, 0))));
  };
  const std::int64_t a = height(from), b = height(to);
  const bool over = radius > 0 && from < middle && middle < to;
  return {std::min(a, b), over ? y0 + radius : std::max(a, b)};
}

std::vector<Floor> FloorsOf(const Part& part) {
  const Rotation<double> turn(static_cast<double>(part.angle));
  const auto place = [&](double x, double y) -> Vector2d {
    return part.position.cast<double>() + turn(Vector2d(x, y));
  };
  std::vector<Vector2d> points;
  for (const Vec2& p : part.points) {
    const Vector2d local = p.cast<double>();
    points.push_back(place(local.x(), local.y()));
  }
  const Vector2d half = part.size.cast<double>() / 2;
  const auto radius = static_cast<double>(part.radius);
  std::vector<Floor> floors;
  switch (part.kind) {
    case ShapeKind::kBox:
      AddPolygon({place(-half.x(), -half.y()), place(half.x(), -half.y()),
                  place(half.x(), half.y()), place(-half.x(), half.y())},
                 &floors);
      break;
    case ShapeKind::kCircle: AddCircle(place(0, 0), radius, &floors); break;
    case ShapeKind::kCapsule: {
      for (const Vector2d& centre : points) AddCircle(centre, radius, &floors);
      const Vector2d along = points[1] - points[0];
      Vector2d up = Vector2d(-along.y(), along.x()).normalized() * radius;
      if (up.y() < 0) up = -up;
      AddLine(points[0] + up, points[1] + up, &floors);
      break;
    }
    case ShapeKind::kPolygon: AddPolygon(points, &floors); break;
    case ShapeKind::kChain:
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (points[i].x() < points[i + 1].x()) AddLine(points[i], points[i + 1], &floors);
      }
      break;
    case ShapeKind::kSegment: AddLine(points[0], points[1], &floors); break;
  }
  return floors;
}

}  // namespace seam
