#include "common/stages/water/wet_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/base/trig.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

/// Distance outside an edge at which another part is searched for, and growth of that part for the
/// search, m. Faces up to 1.5 mm apart touch, and of two coincident edges that face the same way
/// neither covers the other.
constexpr double kLookOut = 1e-3, kLarger = 5e-4;
/// Shorter pieces of edges are left out, m.
constexpr double kWetEdgeMin = 2e-3;

using Span = std::pair<double, double>;  // of an edge, 0..1

std::vector<Vec2d> LocalCorners(const Part& part) {
  std::vector<Vec2d> corners;
  if (part.kind == ShapeKind::kBox) {
    const Vec2d half = part.size.cast<double>() / 2;
    corners = {
        {-half.x(), -half.y()}, {half.x(), -half.y()}, {half.x(), half.y()}, {-half.x(), half.y()}};
  } else if (part.kind == ShapeKind::kPolygon) {
    for (const Vec2& p : part.points) corners.push_back(p.cast<double>());
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2d& a = corners[i];
      const Vec2d& b = corners[(i + 1) % corners.size()];
      twice += Cross(a, b);
    }
    if (twice < 0) std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

/// Returns the corners, from the end at points[1] around to the one at points[0], scaled to the
/// capsule's area.
std::vector<Vec2d> CapsuleCorners(const Part& part) {
  const Vec2d ends[2] = {part.points[1].cast<double>(), part.points[0].cast<double>()};
  const double radius = static_cast<double>(part.radius);
  const double start = Atan2(ends[0].y() - ends[1].y(), ends[0].x() - ends[1].x()) - kPi / 2;
  std::vector<Vec2d> corners;
  for (int cap = 0; cap < 2; ++cap) {
    for (int i = 0; i <= kCapArcs; ++i) {
      const double turn = start + kPi * cap + kPi * i / kCapArcs;
      corners.push_back(ends[cap] + radius * Vec2d(Cos(turn), Sin(turn)));
    }
  }
  const AreaMoments small = AreaOf(corners.data(), static_cast<int>(corners.size()));
  const double area = kPi * radius * radius + 2 * radius * (ends[0] - ends[1]).norm();
  const double grown = std::sqrt(area / small.area);
  for (Vec2d& p : corners) p = small.centre + grown * (p - small.centre);
  return corners;
}

WetPart PartOf(const Part& part, const Part& root) {
  WetPart wet;
  wet.capsule = part.kind == ShapeKind::kCapsule;
  wet.corners = wet.capsule ? CapsuleCorners(part) : LocalCorners(part);
  for (Vec2d& p : wet.corners) p = ToRootFrame(part, root, p);
  if (part.kind == ShapeKind::kCircle) {
    wet.disc = true;
    wet.radius = wet.reach = static_cast<double>(part.radius);
    const double r2 = wet.radius * wet.radius;
    wet.whole = {kPi * r2, ToRootFrame(part, root, {0, 0}), kPi * r2 * r2 / 2};
    return wet;
  }
  wet.whole = AreaOf(wet.corners.data(), static_cast<int>(wet.corners.size()));
  for (const Vec2d& p : wet.corners) {
    wet.reach = std::max(wet.reach, (p - wet.whole.centre).norm());
  }
  return wet;
}

WetEdge EdgeOf(const Vec2d& from, const Vec2d& to, bool arc) {
  const Vec2d along = to - from;
  return {from, to, Vec2d(along.y(), -along.x()) / along.norm(), arc};
}

/// Returns the edges. The pieces of a circle have the total length of its edge, so their ends lie
/// outside it.
std::vector<WetEdge> EdgesOf(const WetPart& part) {
  std::vector<WetEdge> edges;
  if (part.disc) {
    const double turn = 2 * kPi / kArcs;
    for (int i = 0; i < kArcs; ++i) {
      const Vec2d out(Cos(turn * i), Sin(turn * i));
      const Vec2d along(-out.y(), out.x());
      const Vec2d middle = part.whole.centre + part.radius * out;
      const double half = part.radius * turn / 2;
      edges.push_back({middle - half * along, middle + half * along, out, true});
    }
    return edges;
  }
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    const bool arc = part.capsule && (i + 1) % (kCapArcs + 1) != 0;
    edges.push_back(EdgeOf(part.corners[i], part.corners[(i + 1) % part.corners.size()], arc));
  }
  return edges;
}

/// Returns the span of the segment `from`..`to` inside the part; empty (first >= second) if none.
Span SpanIn(const WetPart& part, const Vec2d& from, const Vec2d& to) {
  const Vec2d along = to - from;
  if (part.disc) {
    const double radius = part.radius + kLarger;
    const Vec2d apart = from - part.whole.centre;
    const double a = along.dot(along), b = apart.dot(along);
    const double root = b * b - a * (apart.dot(apart) - radius * radius);
    if (root <= 0) return {1, 0};
    return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
  }
  Span span{0, 1};
  for (const WetEdge& edge : EdgesOf(part)) {
    const double start = edge.normal.dot(from - edge.from) - kLarger;
    const double rise = edge.normal.dot(along);
    if (rise == 0) {
      if (start > 0) return {1, 0};
    } else if (rise < 0) {
      span.first = std::max(span.first, -start / rise);
    } else {
      span.second = std::min(span.second, -start / rise);
    }
  }
  return span;
}

/// Adds the pieces of an edge that `covered` leaves free.
void AddUncovered(const WetEdge& edge, std::vector<Span> covered, std::vector<WetEdge>* out) {
  std::sort(covered.begin(), covered.end());
  covered.emplace_back(1, 1);
  const Vec2d along = edge.to - edge.from;
  double open = 0;
  for (const Span& span : covered) {
    if ((span.first - open) * along.norm() > kWetEdgeMin) {
      out->push_back({edge.from + open * along, edge.from + std::min(1.0, span.first) * along,
                      edge.normal, edge.arc});
    }
    open = std::max(open, span.second);
    if (open >= 1) return;
  }
}

}  // namespace

WetShape WetShapeOf(const Scene& scene, const Assembly& assembly) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  WetShape shape;
  for (const PartId id : assembly.parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    if (!IsLine(part.kind)) shape.parts.push_back(PartOf(part, root));
  }
  shape.box.min = Vec2d(1e9, 1e9);
  shape.box.max = -shape.box.min;
  for (const WetPart& part : shape.parts) {
    for (const WetEdge& edge : EdgesOf(part)) {
      std::vector<Span> covered;
      const Vec2d out = kLookOut * edge.normal;
      for (const WetPart& other : shape.parts) {
        const Vec2d middle = (edge.from + edge.to) / 2;
        const double apart = (other.whole.centre - middle).norm();
        const double reach = other.reach + (edge.to - edge.from).norm() / 2 + 2 * kLookOut;
        if (&other == &part || apart > reach) continue;
        const Span span = SpanIn(other, edge.from + out, edge.to + out);
        if (span.first < span.second) covered.push_back(span);
      }
      AddUncovered(edge, std::move(covered), &shape.edges);
    }
    const Vec2d reach(part.radius, part.radius);
    const std::vector<Vec2d> disc = {part.whole.centre - reach, part.whole.centre + reach};
    for (const Vec2d& p : part.disc ? disc : part.corners) {
      shape.box.min = shape.box.min.cwiseMin(p);
      shape.box.max = shape.box.max.cwiseMax(p);
    }
  }
  shape.centre = (shape.box.min + shape.box.max) / 2;
  shape.reach = (shape.box.max - shape.centre).norm();
  return shape;
}

WetCells CellsOf(const WetShape& shape, int n) {
  const Vec2d step = (shape.box.max - shape.box.min) / n;
  WetCells cells{std::vector<AreaMoments>(static_cast<std::size_t>(n * n)), step};
  for (const WetPart& part : shape.parts) {
    const auto index = [&](double from, double unit, double value) {
      return std::clamp(static_cast<int>(std::floor((value - from) / unit)), 0, n - 1);
    };
    const Vec2d low = part.whole.centre - Vec2d(part.reach, part.reach);
    const Vec2d high = part.whole.centre + Vec2d(part.reach, part.reach);
    const int right = index(shape.box.min.x(), step.x(), high.x());
    const int top = index(shape.box.min.y(), step.y(), high.y());
    for (int row = index(shape.box.min.y(), step.y(), low.y()); row <= top; ++row) {
      for (int column = index(shape.box.min.x(), step.x(), low.x()); column <= right; ++column) {
        const Vec2d corner = shape.box.min + Vec2d(column * step.x(), row * step.y());
        const Bounds bounds{corner, corner + step};
        Add(part.disc
                ? DiscWithin(part.whole.centre, part.radius, bounds)
                : AreaWithin(part.corners.data(), static_cast<int>(part.corners.size()), bounds),
            &cells.pieces[static_cast<std::size_t>(row * n + column)]);
      }
    }
  }
  const auto empty = [](const AreaMoments& piece) { return piece.area <= 0; };
  cells.pieces.erase(std::remove_if(cells.pieces.begin(), cells.pieces.end(), empty),
                     cells.pieces.end());
  return cells;
}

}  // namespace seam
