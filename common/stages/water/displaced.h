#pragma once
/// Computes the parts of shapes inside a rectangle: the area that a floating body displaces. Pure
/// geometry in double precision.

#include <Eigen/Core>

namespace seam {

using Vec2d = Eigen::Vector2d;

/// An area, its centroid and its second moment.
struct AreaMoments {
  double area = 0;     ///< m^2
  Vec2d centre{0, 0};  ///< m
  double second = 0;   ///< m^4: integral of the squared distance from the centre
};

/// An upright rectangle; as water, its top is the level.
struct Bounds {
  Vec2d min{0, 0}, max{0, 0};  ///< m
};

/// Largest number of a polygon's corners for AreaWithin.
constexpr int kCutCornersMax = 64;

/// Returns the moments of a convex polygon, counter-clockwise, 3..kCutCornersMax corners.
AreaMoments AreaOf(const Vec2d* corners, int count);
/// Returns the moments of its part within the bounds (Sutherland and Hodgman 1974).
AreaMoments AreaWithin(const Vec2d* corners, int count, const Bounds& bounds);
/// Returns the moments of the part of a disc within the bounds: exact if only one side cuts it (a
/// segment), else by a polygon of 64 corners of the same area.
AreaMoments DiscWithin(const Vec2d& centre, double radius, const Bounds& bounds);

/// Clips a segment to the bounds (Liang and Barsky 1984); returns false if nothing is left.
bool Shorten(const Bounds& bounds, Vec2d* from, Vec2d* to);

/// Adds an area to another.
void Add(const AreaMoments& more, AreaMoments* sum);

}  // namespace seam
