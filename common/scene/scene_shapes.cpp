
#include "common/base/geometry.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Returns the number of a point, from 1, for messages.
std::string Number(std::size_t i) { return std::to_string(i + 1); }

std::string TooClose(std::size_t i, std::size_t k) {
  return "points " + Number(i) + " and " + Number(k) + " are closer than " + Decimal(kEdgeMin) +
         " m";
}

/// Twice the signed area, m^2 (shoelace formula).
double TwiceArea(const std::vector<Vec2>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += Cross(points[i].cast<double>(), points[(i + 1) % points.size()].cast<double>());
  }
  return sum;
}

void CheckPolygon(const SceneReader& r, const char* key, float size_max, const Part& part) {
  const Status status = ValidatePolygon(part.points, size_max);
  if (!status.ok()) r.FailAt(key, status.why());
}

void ReadCapsule(const SceneReader& r, float size_max, Part* part) {
  const Vec2 size = r.Vector("capsule", {kEdgeMin, size_max});
  const float half = size.x() / 2;
  part->kind = ShapeKind::kCapsule;
  part->points = {{-half, 0}, {half, 0}};
  part->radius = size.y();
  if (part->radius < kSizeMin / 2 || size.x() + 2 * part->radius > size_max) {
    r.FailAt("capsule",
             "a capsule is [length between its ends' centres, radius]; the radius at "
             "least " +
                 Decimal(kSizeMin / 2) + " m, the whole at most " + Decimal(size_max) + " m long");
  }
}

/// Reads a right triangle, centred in the box of its legs, with the right angle at the lower right:
/// a ramp up to the right; with a negative width, up to the left.
void ReadWedge(const SceneReader& r, float size_max, Part* part) {
  const Vec2 half = r.Vector("wedge", {-size_max, size_max}) / 2;
  part->kind = ShapeKind::kPolygon;
  part->points = {{-half.x(), -half.y()}, {half.x(), -half.y()}, half};
  if (half.y() <= 0) r.FailAt("wedge", "a wedge's height must be positive");
  CheckPolygon(r, "wedge", size_max, *part);
}

void ReadLine(const SceneReader& r, const char* key, float size_max, Part* part) {
  const bool chain = part->kind == ShapeKind::kChain;
  const Range range = part->anchored ? kCoordinate : Range{-size_max, size_max};
  part->points = r.Points(key, range, chain ? kChainPointsMax : 2);
  if (!chain && part->points.size() != 2) r.FailAt(key, "a segment has 2 points");
  const Status status = ValidateChain(part->points);
  if (!status.ok()) r.FailAt(key, status.why());
}

}  // namespace

void ReadShape(const SceneReader& r, float size_max, Part* part) {
  const int shapes = r.Has("box") + r.Has("circle") + r.Has("capsule") + r.Has("wedge") +
                     r.Has("polygon") + r.Has("chain") + r.Has("segment");
  if (shapes != 1) {
    r.Fail("needs exactly one of box, circle, capsule, wedge, polygon, chain and segment");
  }
  if (r.Has("box")) {
    part->kind = ShapeKind::kBox;
    part->size = r.Vector("box", {kSizeMin, size_max});
  } else if (r.Has("circle")) {
    part->kind = ShapeKind::kCircle;
    part->radius = r.Number("circle", {kSizeMin / 2, size_max / 2});
  } else if (r.Has("capsule")) {
    ReadCapsule(r, size_max, part);
  } else if (r.Has("wedge")) {
    ReadWedge(r, size_max, part);
  } else if (r.Has("polygon")) {
    part->kind = ShapeKind::kPolygon;
    part->points = r.Points("polygon", {-size_max, size_max}, kPolygonPointsMax);
    CheckPolygon(r, "polygon", size_max, *part);
  } else if (r.Has("chain")) {
    part->kind = ShapeKind::kChain;
    ReadLine(r, "chain", size_max, part);
  } else {
    part->kind = ShapeKind::kSegment;
    ReadLine(r, "segment", size_max, part);
  }
}

Status ValidatePolygon(const std::vector<Vec2>& points, float size_max) {
  const std::size_t n = points.size();
  if (n < 3)
    return Status::Error("a polygon needs 3 to " + std::to_string(kPolygonPointsMax) + " points");
  Vec2 low = points[0], high = points[0];
  for (std::size_t i = 0; i < n; ++i) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
    for (std::size_t k = 0; k < i; ++k) {
      if ((points[i] - points[k]).norm() < kEdgeMin) {
        return Status::Error(TooClose(k, i));
      }
    }
  }
  if ((high - low).minCoeff() < kSizeMin || (high - low).maxCoeff() > size_max) {
    return Status::Error("a polygon's width and height must be from " + Decimal(kSizeMin) + " to " +
                         Decimal(size_max) + " m");
  }
  const double area = TwiceArea(points) / 2;
  if (std::abs(area) < static_cast<double>(kAreaMin)) {
    return Status::Error("the area must be at least " + Decimal(kAreaMin) + " m^2");
  }
  // Convex and wound only once if all other points are strictly on the inner side of every edge.
  const double turn = area > 0 ? 1 : -1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 edge = points[(i + 1) % n] - points[i];
    for (std::size_t k = 2; k < n; ++k) {
      const std::size_t other = (i + k) % n;
      const Vec2 way = points[other] - points[i];
      const double inside = turn * Cross(edge.cast<double>(), way.cast<double>()) / edge.norm();
      if (inside < static_cast<double>(kConvexMin)) {
        return Status::Error("not convex at point " + Number(other) +
                             " (or three points in one line)");
      }
    }
  }
  return Status::Ok();
}

Status ValidateChain(const std::vector<Vec2>& points) {
  if (points.size() < 2) return Status::Error("a chain needs 2 points or more");
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - points[i - 1]).norm() < kEdgeMin) {
      return Status::Error(TooClose(i - 1, i));
    }
  }
  return Status::Ok();
}

}  // namespace seam
