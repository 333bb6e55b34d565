#pragma once
/// Areas that a rectangle cuts out of shapes: what a floating thing displaces. Pure geometry in
/// double precision.

#include <Eigen/Core>

namespace seam {

using Vec2d = Eigen::Vector2d;

/// An area, where its middle is, and how far it is spread.
struct AreaMoments {
  double area = 0;     ///< m^2
  Vec2d centre{0, 0};  ///< m
  double second = 0;   ///< m^4: integral of the squared distance from the centre
};

/// An upright rectangle: of water, its top is the level.
struct Bounds {
  Vec2d min{0, 0}, max{0, 0};  ///< m
};

/// Most corners of a polygon that AreaWithin takes.
constexpr int kCutCornersMax = 64;

/// Of a convex polygon, counter-clockwise, 3..kCutCornersMax corners.
AreaMoments AreaOf(const Vec2d* corners, int count);
/// Of what of it lies within the bounds (Sutherland and Hodgman 1974).
AreaMoments AreaWithin(const Vec2d* corners, int count, const Bounds& bounds);
/// Of what of a disc lies within the bounds: exact where only one side cuts it (a segment), else as
/// a polygon of 64 corners of the same area.
AreaMoments DiscWithin(const Vec2d& centre, double radius, const Bounds& bounds);

/// Shortens a way to what of it lies within the bounds (Liang and Barsky 1984); false if nothing
/// does.
bool Shorten(const Bounds& bounds, Vec2d* from, Vec2d* to);

/// Adds an area to another.
void Add(const AreaMoments& more, AreaMoments* sum);

}  // namespace seam
