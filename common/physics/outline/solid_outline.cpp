#include "common/physics/outline/solid_outline.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/base/geometry.h"
#include "common/base/spatial/box_sweep.h"
#include "common/base/trig.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Rounding of positions, m.
constexpr double kRounding = 1e-3;
/// Shorter stretches are no part of an outline, m.
constexpr double kStretchMin = 5e-3;
/// Sine above which two lines have a definite intersection, and below which they are one line.
constexpr double kParallel = 0.1;
/// Cosine below which two directions are opposite.
constexpr double kBack = -0.99;

struct Extent {
  Eigen::Vector2f min{0, 0}, max{0, 0};
};

Extent ExtentOf(const SolidPolygon& polygon) {
  Vector2d min = polygon.points.front(), max = min;
  for (const Vector2d& p : polygon.points) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  return {min.cast<float>(), max.cast<float>()};
}

/// Returns the polygons near each one, ascending.
std::vector<std::vector<int>> NeighboursOf(const std::vector<SolidPolygon>& polygons, double gap) {
  std::vector<Extent> extents;
  for (const SolidPolygon& polygon : polygons) extents.push_back(ExtentOf(polygon));
  std::vector<std::vector<int>> neighbours(polygons.size());
  const auto grow = [gap](std::size_t) { return static_cast<float>(gap); };
  BoxSweep(extents, grow).EachPair([&](int a, int b) {
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  });
  for (std::vector<int>& near : neighbours) std::sort(near.begin(), near.end());
  return neighbours;
}

/// True if everything that collides with `side` also collides with `cover`.
bool Hides(const SolidPolygon& cover, const SolidPolygon& side) {
  return cover.group >= 0 || cover.group == side.group;
}

using Stretch = std::pair<double, double>;  // along a side, m

/// Returns the stretch of the line within the polygon, grown by kRounding; nullopt: none.
std::optional<Stretch> Within(const SolidPolygon& polygon, const Vector2d& from,
                              const Vector2d& along, double length) {
  Stretch inside{0, length};
  for (std::size_t i = 0; i < polygon.points.size(); ++i) {
    const Vector2d& a = polygon.points[i];
    const Vector2d& b = polygon.points[(i + 1) % polygon.points.size()];
    const Vector2d side = (b - a).normalized();
    const Vector2d out(side.y(), -side.x());
    const double beyond = out.dot(from - a) - kRounding, slope = out.dot(along);
    if (std::fabs(slope) < 1e-9) {
      if (beyond > 0) return std::nullopt;
      continue;
    }
    const double at = -beyond / slope;
    if (slope > 0) inside.second = std::min(inside.second, at);
    if (slope < 0) inside.first = std::max(inside.first, at);
  }
  if (inside.first >= inside.second) return std::nullopt;
  return inside;
}

/// Takes `hidden` out of the stretches.
void Remove(const Stretch& hidden, std::vector<Stretch>* stretches) {
  std::vector<Stretch> left;
  for (const Stretch& s : *stretches) {
    const Stretch low{s.first, std::min(s.second, hidden.first)};
    const Stretch high{std::max(s.first, hidden.second), s.second};
    if (low.second - low.first > kStretchMin) left.push_back(low);
    if (high.second - high.first > kStretchMin) left.push_back(high);
  }
  *stretches = std::move(left);
}

/// An edge with the data that is needed to link it.
struct Piece {
  Vector2d from{0, 0}, to{0, 0}, along{0, 0};
  bool begins = false, ends = false;  // at a corner of its polygon
  std::size_t side = 0;
};

/// Finds the pieces of one polygon that no neighbour hides.
std::vector<Piece> PiecesOf(const std::vector<SolidPolygon>& polygons, std::size_t index,
                            const std::vector<int>& near, double gap) {
  const SolidPolygon& polygon = polygons[index];
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < polygon.points.size(); ++i) {
    const Vector2d& a = polygon.points[i];
    const Vector2d& b = polygon.points[(i + 1) % polygon.points.size()];
    const double length = (b - a).norm();
    const Vector2d along = (b - a) / length, out(along.y(), -along.x());
    std::vector<Stretch> seen = {{0, length}};
    for (const int other : near) {
      const SolidPolygon& cover = polygons[static_cast<std::size_t>(other)];
      if (!Hides(cover, polygon)) continue;
      const std::optional<Stretch> hidden = Within(cover, a + gap * out, along, length);
      if (hidden) Remove(*hidden, &seen);
    }
    for (const Stretch& s : seen) {
      pieces.push_back(
          {a + s.first * along, a + s.second * along, along, s.first == 0, s.second == length, i});
    }
  }
  return pieces;
}

/// Finds the pieces that follow each other.
class Linker {
 public:
  Linker(const std::vector<SolidPolygon>& polygons, const std::vector<std::vector<int>>& near,
         const std::vector<std::vector<Piece>>& pieces, double gap)
      : polygons_(polygons), near_(near), pieces_(pieces), reach_(2 * gap) {}

  /// Returns the edge of a piece; sets `joined` if it goes on in another polygon.
  OutlineEdge EdgeOf(std::size_t polygon, std::size_t index, bool* joined) const {
    const Piece& piece = pieces_[polygon][index];
    OutlineEdge edge{piece.from, piece.to, OwnBefore(polygon, piece), OwnAfter(polygon, piece)};
    const Link before = Find(polygon, piece, false), after = Find(polygon, piece, true);
    if (before.found) edge.before = before.along;
    if (after.found) edge.after = after.along;
    if (before.other) edge.from = Joint(piece, piece.from, before);
    if (after.other) edge.to = Joint(piece, piece.to, after);
    *joined = before.other || after.other;
    return edge;
  }

 private:
  struct Link {
    bool found = false, other = false;  // `other`: it is another polygon's
    Vector2d along{0, 0}, at{0, 0};
    double turn = 0;  // rad, to the left
  };

  Vector2d OwnSide(std::size_t polygon, std::size_t side) const {
    const std::vector<Vector2d>& points = polygons_[polygon].points;
    return (points[(side + 1) % points.size()] - points[side % points.size()]).normalized();
  }
  Vector2d OwnBefore(std::size_t polygon, const Piece& piece) const {
    return OwnSide(polygon, piece.side + polygons_[polygon].points.size() - 1);
  }
  Vector2d OwnAfter(std::size_t polygon, const Piece& piece) const {
    return OwnSide(polygon, piece.side + 1);
  }

  /// Finds the piece after `piece`, or before it: at a corner of its polygon, or another polygon's.
  /// Of several it is the one with air between: the farthest to the right.
  Link Find(std::size_t polygon, const Piece& piece, bool after) const {
    Link best;
    const std::size_t sides = polygons_[polygon].points.size();
    for (const Piece& next : pieces_[polygon]) {
      const Piece &first = after ? piece : next, &second = after ? next : piece;
      const bool corner = first.ends && second.begins && second.side == (first.side + 1) % sides;
      if (corner) Consider(piece, next, after, false, &best);
    }
    for (const int other : near_[polygon]) {
      const auto of = static_cast<std::size_t>(other);
      if (!Hides(polygons_[of], polygons_[polygon])) continue;
      for (const Piece& next : pieces_[of]) Consider(piece, next, after, true, &best);
    }
    return best;
  }

  void Consider(const Piece& piece, const Piece& next, bool after, bool other, Link* best) const {
    const Vector2d& end = after ? piece.to : piece.from;
    Vector2d begin = after ? next.from : next.to;
    const Vector2d along = after ? next.along : -next.along;
    const Vector2d from = after ? piece.along : -piece.along;
    bool meets = (begin - end).norm() <= reach_;
    // Flush with a side of another polygon that overlaps.
    const bool flush = piece.along.dot(next.along) > 0 && other &&
                       std::fabs(Cross(piece.along, next.along)) < kParallel;
    if (flush && !meets) {
      const double at = next.along.dot(end - next.from);
      const double off = Cross(next.along, end - next.from);
      meets = at > 0 && at < (next.to - next.from).norm() && std::fabs(off) < 2 * kRounding;
      begin = end;
    }
    const bool back = piece.along.dot(next.along) < kBack;  // the other wall of a crack
    if (!meets || back) return;
    // Backwards along the outline, left and right change.
    const double turn = Atan2(Cross(from, along), from.dot(along)) * (after ? 1 : -1);
    if (best->found && turn >= best->turn) return;
    *best = {true, other, next.along, begin, turn};
  }

  /// Returns the point at which the lines of two linked pieces meet.
  Vector2d Joint(const Piece& piece, const Vector2d& end, const Link& link) const {
    const double sine = Cross(piece.along, link.along);
    const Vector2d to = link.at - end;
    const double ahead =
        std::fabs(sine) > kParallel ? Cross(to, link.along) / sine : piece.along.dot(to) / 2;
    return std::fabs(ahead) <= reach_ ? Vector2d(end + ahead * piece.along) : end;
  }

  const std::vector<SolidPolygon>& polygons_;
  const std::vector<std::vector<int>>& near_;
  const std::vector<std::vector<Piece>>& pieces_;
  const double reach_;  // m
};

bool IsWhole(const std::vector<Piece>& pieces, std::size_t sides) {
  return pieces.size() == sides && std::all_of(pieces.begin(), pieces.end(),
                                               [](const Piece& p) { return p.begins && p.ends; });
}

}  // namespace

std::vector<SolidOutline> OutlinesOf(const std::vector<SolidPolygon>& polygons, double gap) {
  std::vector<SolidOutline> outlines(polygons.size());
  if (polygons.size() < 2) return outlines;
  const std::vector<std::vector<int>> near = NeighboursOf(polygons, gap);
  std::vector<std::vector<Piece>> pieces(polygons.size());
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (!near[p].empty()) pieces[p] = PiecesOf(polygons, p, near[p], gap);
  }
  const Linker linker(polygons, near, pieces, gap);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (near[p].empty()) continue;
    SolidOutline& outline = outlines[p];
    outline.alone = IsWhole(pieces[p], polygons[p].points.size());
    for (std::size_t i = 0; i < pieces[p].size(); ++i) {
      bool joined = false;
      outline.edges.push_back(linker.EdgeOf(p, i, &joined));
      outline.alone = outline.alone && !joined;
    }
    if (outline.alone) outline.edges.clear();
  }
  return outlines;
}

}  // namespace seam
