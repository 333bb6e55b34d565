#include "common/stages/water/displaced.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/base/trig.h"

namespace seam {
namespace {

/// Each of the four cuts adds at most one corner to a convex polygon.
constexpr int kCornersMax = kCutCornersMax + 4;

/// Keeps the points with sign * (coordinate - limit) <= 0; returns the number of corners left.
int Cut(const Vec2d* in, int count, int axis, double limit, double sign, Vec2d* out) {
  int left = 0;
  for (int i = 0; i < count; ++i) {
    const Vec2d& a = in[i];
    const Vec2d& b = in[i + 1 < count ? i + 1 : 0];
    const double over_a = sign * (a[axis] - limit), over_b = sign * (b[axis] - limit);
    if (over_a <= 0) out[left++] = a;
    // From the inner to the outer end, so that an edge is cut at identical bits from both sides.
    if ((over_a <= 0) == (over_b <= 0)) continue;
    const Vec2d& inner = over_a <= 0 ? a : b;
    const Vec2d& outer = over_a <= 0 ? b : a;
    const double in_over = std::min(over_a, over_b), out_over = std::max(over_a, over_b);
    out[left++] = inner + (outer - inner) * (in_over / (in_over - out_over));
  }
  return left;
}

/// Returns the part of a disc beyond a line at `depth` from its centre, -radius..radius: larger for
/// a larger depth. `towards`: unit, from the line into that part.
AreaMoments Segment(const Vec2d& centre, double radius, double depth, const Vec2d& towards) {
  // Half the angle subtended by the chord.
  const double chord = std::sqrt(std::max(0.0, radius * radius - depth * depth));
  const double half = Atan2(chord, -depth);
  const double r2 = radius * radius;
  AreaMoments part;
  part.area = r2 * half + depth * chord;
  if (part.area <= 0) return {};
  // First moment along `towards` from the disc's centre, and second moment about the centre: a
  // sector of angle 2 half has r^4 half / 2, and the triangle of the chord and the centre adds the
  // rest.
  const double first = 2 * chord * chord * chord / 3;
  const double about = r2 * r2 * half / 2 + depth * chord * (depth * depth / 2 + chord * chord / 6);
  const double arm = first / part.area;
  part.centre = centre + towards * arm;
  part.second = std::max(0.0, about - part.area * arm * arm);
  return part;
}

AreaMoments DiscAsPolygon(const Vec2d& centre, double radius, const Bounds& bounds) {
  Vec2d corners[kCutCornersMax];
  const double turn = 2 * kPi / kCutCornersMax;
  const double reach = radius * std::sqrt(turn / Sin(turn));
  for (int i = 0; i < kCutCornersMax; ++i) {
    corners[i] = centre + reach * Vec2d(Cos(turn * i), Sin(turn * i));
  }
  return AreaWithin(corners, kCutCornersMax, bounds);
}

}  // namespace

AreaMoments AreaOf(const Vec2d* corners, int count) {
  // Sums over the triangles between the first corner and each edge, as in mass.cpp.
  double twice = 0, second = 0;
  Vec2d first{0, 0};
  for (int i = 1; i + 1 < count; ++i) {
    const Vec2d a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
    const double cross = Cross(a, b);
    twice += cross;
    first += cross * (a + b);
    second += cross * (a.dot(a) + a.dot(b) + b.dot(b));
  }
  if (twice <= 0) return {};
  const Vec2d arm = first / (3 * twice);
  return {twice / 2, corners[0] + arm, std::max(0.0, second / 12 - twice / 2 * arm.dot(arm))};
}

AreaMoments AreaWithin(const Vec2d* corners, int count, const Bounds& bounds) {
  SEAM_ASSERT(count >= 3 && count <= kCutCornersMax);
  Vec2d low = corners[0], high = corners[0];
  for (int i = 1; i < count; ++i) {
    low = low.cwiseMin(corners[i]);
    high = high.cwiseMax(corners[i]);
  }
  Vec2d one[kCornersMax], other[kCornersMax];
  const Vec2d* now = corners;
  Vec2d* free = one;
  const auto cut = [&](int axis, double limit, double sign) {
    count = Cut(now, count, axis, limit, sign, free);
    now = free;
    free = free == one ? other : one;
    return count >= 3;
  };
  if (high.y() > bounds.max.y() && !cut(1, bounds.max.y(), 1)) return {};
  if (low.y() < bounds.min.y() && !cut(1, bounds.min.y(), -1)) return {};
  if (high.x() > bounds.max.x() && !cut(0, bounds.max.x(), 1)) return {};
  if (low.x() < bounds.min.x() && !cut(0, bounds.min.x(), -1)) return {};
  return AreaOf(now, count);
}

AreaMoments DiscWithin(const Vec2d& centre, double radius, const Bounds& bounds) {
  // Depth of the centre inside each side.
  const double depths[4] = {bounds.max.y() - centre.y(), centre.y() - bounds.min.y(),
                            bounds.max.x() - centre.x(), centre.x() - bounds.min.x()};
  static const Vec2d kInwards[4] = {{0, -1}, {0, 1}, {-1, 0}, {1, 0}};
  int cuts = 0, by = 0;
  for (int side = 0; side < 4; ++side) {
    if (depths[side] <= -radius) return {};
    if (depths[side] >= radius) continue;
    ++cuts;
    by = side;
  }
  const double r2 = radius * radius;
  if (cuts == 0) return {kPi * r2, centre, kPi * r2 * r2 / 2};
  if (cuts == 1) return Segment(centre, radius, depths[by], kInwards[by]);
  return DiscAsPolygon(centre, radius, bounds);
}

void Add(const AreaMoments& more, AreaMoments* sum) {
  if (more.area <= 0) return;
  const double area = sum->area + more.area;
  const Vec2d apart = more.centre - sum->centre;
  sum->second += more.second + sum->area * more.area / area * apart.dot(apart);
  sum->centre += apart * (more.area / area);
  sum->area = area;
}

bool Shorten(const Bounds& bounds, Vec2d* from, Vec2d* to) {
  const Vec2d along = *to - *from;
  double first = 0, last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = along[axis];
    const double low = bounds.min[axis] - (*from)[axis], high = bounds.max[axis] - (*from)[axis];
    if (step == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    first = std::max(first, (step > 0 ? low : high) / step);
    last = std::min(last, (step > 0 ? high : low) / step);
  }
  if (first >= last) return false;
  const Vec2d start = *from;
  *from = start + first * along;
  *to = start + last * along;
  return true;
}

}  // namespace seam
