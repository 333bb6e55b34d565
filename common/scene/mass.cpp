#include "common/scene/mass.h"

#include <cmath>

#include "common/base/geometry.h"
#include "common/scene/motion/part_motion.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Sums over the triangles between the first point and each edge. A triangle with corners 0, a and
/// b has the centroid (a + b)/3 and, about corner 0, the moment (a.a + a.b + b.b)/6 per mass.
MassProperties PolygonProperties(const Part& part, double density) {
  const Eigen::Vector2d base = part.points[0].cast<double>();
  double area = 0, second = 0;
  Eigen::Vector2d first{0, 0};
  for (std::size_t i = 1; i + 1 < part.points.size(); ++i) {
    const Eigen::Vector2d a = part.points[i].cast<double>() - base;
    const Eigen::Vector2d b = part.points[i + 1].cast<double>() - base;
    const double triangle = Cross(a, b) / 2;
    area += triangle;
    first += triangle / 3 * (a + b);
    second += triangle / 6 * (a.dot(a) + a.dot(b) + b.dot(b));
  }
  const Eigen::Vector2d offset = first / area;
  // Clockwise points make area and second negative together.
  return {density * std::abs(area), base + offset,
          density * (std::abs(second) - std::abs(area) * offset.dot(offset))};
}

/// A box and two half discs. The centroid of a half disc is 4 r/3 pi from its flat side: about a
/// point d beyond the flat side, its moment per mass is r^2/2 + 2 d 4 r/3 pi + d^2.
MassProperties CapsuleProperties(const Part& part, double density) {
  const Eigen::Vector2d first = part.points[0].cast<double>(), last = part.points[1].cast<double>();
  const double length = (last - first).norm(), r = static_cast<double>(part.radius);
  const double box = density * length * 2 * r, discs = density * kPi * r * r;
  const double d = length / 2;
  const double inertia = box * (length * length + 4 * r * r) / 12 +
                         discs * (r * r / 2 + 8 * d * r / (3 * kPi) + d * d);
  return {box + discs, (first + last) / 2, inertia};
}

/// Strips of kLineWidth along the segments: each has the moment m (length^2 + width^2) / 12.
MassProperties LineProperties(const Part& part, double density) {
  constexpr auto kWidth = static_cast<double>(kLineWidth);
  MassProperties all;
  double second = 0;  // about the part's position
  for (std::size_t i = 0; i + 1 < part.points.size(); ++i) {
    const Eigen::Vector2d from = part.points[i].cast<double>(),
                          to = part.points[i + 1].cast<double>();
    const double length = (to - from).norm(), mass = density * length * kWidth;
    const Eigen::Vector2d middle = (from + to) / 2;
    all.mass += mass;
    all.centre += mass * middle;
    second += mass * ((length * length + kWidth * kWidth) / 12 + middle.squaredNorm());
  }
  all.centre /= all.mass;
  all.inertia = second - all.mass * all.centre.squaredNorm();
  return all;
}

MassProperties ShapeProperties(const Part& part) {
  const double density = static_cast<double>(part.material.density);
  switch (part.kind) {
    case ShapeKind::kBox: {
      const Eigen::Vector2d size = part.size.cast<double>();
      const double mass = density * size.x() * size.y();
      return {mass, {0, 0}, mass * size.dot(size) / 12};
    }
    case ShapeKind::kCircle: {
      const double radius = static_cast<double>(part.radius);
      const double mass = density * kPi * radius * radius;
      return {mass, {0, 0}, mass * radius * radius / 2};
    }
    case ShapeKind::kCapsule: return CapsuleProperties(part, density);
    case ShapeKind::kPolygon: return PolygonProperties(part, density);
    case ShapeKind::kChain:
    case ShapeKind::kSegment:
      return part.anchored ? MassProperties{} : LineProperties(part, density);
  }
  return {};
}

}  // namespace

MassProperties PartProperties(const Part& part) {
  MassProperties own = ShapeProperties(part);
  if (part.motion->fixed_rotation) own.inertia = kFixedInertia;
  return own;
}

Eigen::Vector2d ToRootFrame(const Part& part, const Part& root, const Eigen::Vector2d& point) {
  // Exact for the root itself: rounding must not shift a single part's shape. (A merged face has
  // the number of one of its parts, but another pose.)
  if (part.id == root.id && part.position == root.position) return point;
  const double turn = static_cast<double>(part.angle);
  const double back = -static_cast<double>(root.angle);
  const Eigen::Vector2d apart = part.position.cast<double>() - root.position.cast<double>();
  return Turned(apart + Turned(point, turn), back);
}

MassProperties AssemblyProperties(const Scene& scene, const Assembly& assembly) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  if (assembly.parts.size() == 1) return PartProperties(root);
  MassProperties all;
  for (const PartId id : assembly.parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const MassProperties own = PartProperties(part);
    all.mass += own.mass;
    all.centre += own.mass * ToRootFrame(part, root, own.centre);
  }
  if (all.mass > 0) all.centre /= all.mass;
  for (const PartId id : assembly.parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const MassProperties own = PartProperties(part);
    const Eigen::Vector2d arm = ToRootFrame(part, root, own.centre) - all.centre;
    all.inertia += own.inertia + own.mass * arm.dot(arm);
  }
  return all;
}

}  // namespace seam
