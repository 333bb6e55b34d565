#include <algorithm>

#include "common/physics/scene_draft.h"
#include "common/physics/scene_limits.h"

namespace seam {
namespace {

double Cross(const Vec2& a, const Vec2& b) {
  return static_cast<double>(a.x()) * static_cast<double>(b.y()) -
         static_cast<double>(a.y()) * static_cast<double>(b.x());
}

/// Points are counted from 1 in messages.
std::string Number(std::size_t i) { return std::to_string(i + 1); }

std::string TooClose(std::size_t i, std::size_t k) {
  return "points " + Number(i) + " and " + Number(k) + " are closer than " + Decimal(kEdgeMin) +
         " m";
}

/// Twice the signed area, m^2 (shoelace formula).
double TwiceArea(const std::vector<Vec2>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += Cross(points[i], points[(i + 1) % points.size()]);
  }
  return sum;
}

}  // namespace

std::string PolygonComplaint(const std::vector<Vec2>& points, float size_max) {
  const std::size_t n = points.size();
  if (n < 3) return "a polygon needs 3 to 8 points";
  Vec2 low = points[0], high = points[0];
  for (std::size_t i = 0; i < n; ++i) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
    for (std::size_t k = 0; k < i; ++k) {
      if ((points[i] - points[k]).norm() < kEdgeMin) {
        return TooClose(k, i);
      }
    }
  }
  if ((high - low).minCoeff() < kSizeMin || (high - low).maxCoeff() > size_max) {
    return "a polygon's width and height must be from " + Decimal(kSizeMin) + " to " +
           Decimal(size_max) + " m";
  }
  const double area = TwiceArea(points) / 2;
  if (std::abs(area) < static_cast<double>(kAreaMin)) {
    return "the area must be at least " + Decimal(kAreaMin) + " m^2";
  }
  // Every other point strictly on the inner side of every edge: convex, and wound only once.
  const double turn = area > 0 ? 1 : -1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 edge = points[(i + 1) % n] - points[i];
    for (std::size_t k = 2; k < n; ++k) {
      const std::size_t other = (i + k) % n;
      const double inside = turn * Cross(edge, points[other] - points[i]) / edge.norm();
      if (inside < static_cast<double>(kConvexMin)) {
        return "not convex at point " + Number(other) + " (or three points in one line)";
      }
    }
  }
  return "";
}

std::string ChainComplaint(const std::vector<Vec2>& points) {
  if (points.size() < 2) return "a chain needs 2 points or more";
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - points[i - 1]).norm() < kEdgeMin) {
      return TooClose(i - 1, i);
    }
  }
  return "";
}

}  // namespace seam
