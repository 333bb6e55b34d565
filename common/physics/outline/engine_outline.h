#pragma once
/// The engine's shapes as outlines, and back.

#include <box2d/box2d.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/outline/solid_outline.h"
#include "common/physics/world_build.h"

namespace seam {

inline bool IsSolid(const b2Fixture* fixture) {
  return fixture->GetType() == b2Shape::e_polygon && !fixture->IsSensor();
}

inline const b2PolygonShape& PolygonOf(const b2Fixture& fixture) {
  return *static_cast<const b2PolygonShape*>(fixture.GetShape());
}

/// A body's pose in double precision: shapes far from the origin meet to a millimetre.
struct FramePose {
  Eigen::Vector2d shift{0, 0};
  double sine = 0, cosine = 1;

  Eigen::Vector2d Turned(const Eigen::Vector2d& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
  Eigen::Vector2d TurnedBack(const Eigen::Vector2d& v) const {
    return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x()};
  }
  Eigen::Vector2d Out(const b2Vec2& local) const {
    return shift + Turned(FromB2(local).cast<double>());
  }
  b2Vec2 In(const Eigen::Vector2d& point) const {
    return ToB2(TurnedBack(point - shift).cast<float>());
  }
};

/// Returns the shape's points in the frame that `frame` leads to.
inline SolidPolygon SolidOf(const b2Fixture& fixture, const FramePose& frame) {
  const b2PolygonShape& polygon = PolygonOf(fixture);
  SolidPolygon solid;
  solid.group = fixture.GetFilterData().groupIndex;
  for (int32 i = 0; i < polygon.m_count; ++i) {
    solid.points.push_back(frame.Out(polygon.m_vertices[i]));
  }
  return solid;
}

/// Returns the direction of a neighbour of an edge with direction `along`. The engine lets a
/// contact lean over an end by up to 6 degrees if the outline does not rise there. So a neighbour
/// that goes on nearly straight is said to rise a little: by `rise`, to the left or right.
inline Eigen::Vector2d Neighbour(const Eigen::Vector2d& along, const Eigen::Vector2d& next,
                                 double rise) {
  constexpr double kStraight = 0.1;  // sine: as much as the engine lets it lean
  const bool straight = std::fabs(Cross(along, next)) < kStraight && along.dot(next) > 0;
  return straight ? Eigen::Vector2d(along + rise * Eigen::Vector2d(-along.y(), along.x())) : next;
}

/// Returns the edge in the body's frame, with the shape's rim. `frame`: leads from there to the
/// edge's.
inline b2EdgeShape EngineEdge(const OutlineEdge& edge, const b2Fixture& fixture,
                              const FramePose& frame) {
  constexpr double kNeighbourRise = 1e-3;
  const Eigen::Vector2d along = (edge.to - edge.from).normalized();
  b2EdgeShape shape;
  shape.SetOneSided(frame.In(edge.from - Neighbour(along, edge.before, kNeighbourRise)),
                    frame.In(edge.from), frame.In(edge.to),
                    frame.In(edge.to + Neighbour(along, edge.after, -kNeighbourRise)));
  shape.m_radius = fixture.GetShape()->m_radius;
  return shape;
}

}  // namespace seam
