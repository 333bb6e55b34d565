#include "render/import/outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "render/import/plain_names.h"

namespace seam {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

double TwiceAreaOf(const Points& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += Cross(points[i], points[(i + 1) % points.size()]);
  }
  return sum;
}

/// Leaves out points closer than kEdgeMin to the one before.
Points Spaced(const Points& points) {
  Points kept;
  for (const Vector2d& p : points) {
    if (kept.empty() || (p - kept.back()).norm() >= 1.001 * double{kEdgeMin}) kept.push_back(p);
  }
  return kept;
}

/// Leaves out corners nearer than kConvexMin to the line between their neighbours.
Points Cornered(Points points) {
  for (std::size_t i = 0; i < points.size() && points.size() > 3;) {
    const Vector2d& before = points[(i + points.size() - 1) % points.size()];
    const Vector2d& after = points[(i + 1) % points.size()];
    const Vector2d along = after - before;
    const double off = std::fabs(Cross(along, points[i] - before)) / std::max(1e-9, along.norm());
    if (off < 1.5 * double{kConvexMin}) {
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    } else {
      ++i;
    }
  }
  return points;
}

bool IsConvex(const Points& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d& b = points[(i + 1) % points.size()];
    if (Cross(b - points[i], points[(i + 2) % points.size()] - b) < 0) return false;
  }
  return true;
}

double ExtentOf(const Points& points) {
  Vector2d low = points[0], high = points[0];
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return std::max((high - low).maxCoeff(), std::max(-low.minCoeff(), high.maxCoeff()));
}

bool IsPolygon(const Points& points) {
  std::vector<Vec2> floats;
  for (const Vector2d& p : points) floats.push_back(p.cast<float>());
  return ValidatePolygon(floats, kSizeMaxMax).ok();
}

/// Adds a convex, counter-clockwise outline about the mean of its points; a rectangle as a box.
void AddConvex(const Points& points, std::vector<PieceOutline>* pieces) {
  Vector2d centre(0, 0);
  for (const Vector2d& p : points) centre += p / static_cast<double>(points.size());
  PieceOutline piece;
  piece.pose.shift = centre;
  const Vector2d along = points[1] - points[0], up = points.back() - points[0];
  const double width = along.norm(), height = up.norm();
  const bool box = points.size() == 4 && std::fabs(along.dot(up)) < 1e-4 * width * height &&
                   (points[2] - points[1] - up).norm() < 1e-4 * std::max(width, height);
  if (box) {
    if (std::min(width, height) < double{kSizeMin}) return;
    piece.kind = ShapeKind::kBox;
    piece.size = {width, height};
    piece.pose.angle = std::atan2(along.y(), along.x());
    piece.extent = std::max(width, height);
  } else {
    for (const Vector2d& p : points) piece.points.push_back(p - centre);
    if (!IsPolygon(piece.points)) return;
    piece.extent = ExtentOf(piece.points);
  }
  pieces->push_back(std::move(piece));
}

bool IsInside(const Vector2d& p, const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return Cross(b - a, p - a) >= 0 && Cross(c - b, p - b) >= 0 && Cross(a - c, p - c) >= 0;
}

/// Ear clipping (Meisters 1975): cuts off a corner whose triangle holds no other point.
void AddTriangles(Points points, std::vector<PieceOutline>* pieces) {
  bool cut = true;
  while (points.size() > 3 && cut) {
    cut = false;
    for (std::size_t i = 0; i < points.size() && !cut; ++i) {
      const std::size_t n = points.size();
      const Vector2d a = points[(i + n - 1) % n], b = points[i], c = points[(i + 1) % n];
      if (Cross(b - a, c - b) <= 0) continue;
      const bool empty = std::none_of(points.begin(), points.end(), [&](const Vector2d& p) {
        return p != a && p != b && p != c && IsInside(p, a, b, c);
      });
      if (!empty) continue;
      AddConvex({a, b, c}, pieces);
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
    }
  }
  if (points.size() == 3) AddConvex(points, pieces);
}

void AddChain(Points points, std::vector<PieceOutline>* pieces) {
  if (points.size() < 2 || points.size() > kChainPointsMax) return;
  PieceOutline piece;
  piece.kind = ShapeKind::kChain;
  piece.points = std::move(points);
  piece.extent = ExtentOf(piece.points);
  pieces->push_back(std::move(piece));
}

/// A line with two sides that moves: of two chains one would push out and the other in.
void AddSegments(const Points& points, std::vector<PieceOutline>* pieces) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    PieceOutline piece;
    piece.kind = ShapeKind::kSegment;
    piece.points = {points[i - 1], points[i]};
    piece.extent = ExtentOf(piece.points);
    pieces->push_back(std::move(piece));
  }
}

/// A convex outline as one polygon, or cut into halves of at most kPolygonPointsMax points.
void AddOutline(Points points, bool moves, std::vector<PieceOutline>* pieces) {
  if (points.size() > 1 && (points.back() - points.front()).norm() < double{kEdgeMin}) {
    points.pop_back();
  }
  points = Cornered(std::move(points));
  if (points.size() < 3) return;
  if (TwiceAreaOf(points) < 0) std::reverse(points.begin(), points.end());
  Vector2d low = points[0], high = points[0];
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const bool wide = !moves && (high - low).maxCoeff() > double{kSizeMaxMax};
  if (!wide && IsConvex(points) && points.size() <= kPolygonPointsMax) {
    AddConvex(points, pieces);
  } else if (moves) {
    AddTriangles(points, pieces);
  } else {
    points.push_back(points.front());
    std::reverse(points.begin(), points.end());  // a scene's chains are solid on their right
    AddChain(points, pieces);
    if (!pieces->empty()) pieces->back().walled = wide;
  }
}

}  // namespace

std::string ShapeText(const PieceOutline& piece) {
  switch (piece.kind) {
    case ShapeKind::kBox: return fmt::format("box = {}\n", Pair(piece.size));
    case ShapeKind::kCircle: return fmt::format("circle = {:.9g}\n", piece.radius);
    default: break;
  }
  std::string points;
  for (const Vector2d& p : piece.points) points += (points.empty() ? "" : ", ") + Pair(p);
  const char* key = piece.kind == ShapeKind::kPolygon   ? "polygon"
                    : piece.kind == ShapeKind::kSegment ? "segment"
                                                        : "chain";
  return fmt::format("{} = [{}]\n", key, points);
}

std::vector<PieceOutline> PiecesOf(const ImportedShape& shape, bool moves) {
  std::vector<PieceOutline> pieces;
  Points points = Spaced(shape.points);
  switch (shape.kind) {
    case ImportedShape::Kind::kCircle: {
      PieceOutline piece;
      piece.kind = ShapeKind::kCircle;
      piece.pose.shift = shape.centre;
      piece.radius = shape.radius;
      piece.extent = 2 * shape.radius;
      if (shape.radius >= double{kSizeMin} / 2) pieces.push_back(piece);
      break;
    }
    case ImportedShape::Kind::kPolygon: AddOutline(points, moves, &pieces); break;
    case ImportedShape::Kind::kTwoSidedChain:
      if (moves) {
        AddSegments(points, &pieces);
        break;
      }
      AddChain(points, &pieces);
      [[fallthrough]];
    case ImportedShape::Kind::kChain:
      std::reverse(points.begin(), points.end());
      AddChain(points, &pieces);
      break;
  }
  return pieces;
}

}  // namespace seam
