#include "common/physics/outline/outline_contacts.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/physics/outline/line_outline.h"
#include "common/physics/outline/solid_outline.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Edges of one shape that feature ids tell apart: a power of two. Of more, some share an id, and
/// may start the solver with each other's impulses.
constexpr std::size_t kEdgeIds = 16;
/// A point this far beyond the end of an edge is still on it, m.
constexpr float kEdgeSlack = b2_linearSlop;

bool IsSolid(const b2Fixture* fixture) {
  return fixture->GetType() == b2Shape::e_polygon && !fixture->IsSensor();
}

bool IsSegment(const b2Fixture* fixture) {
  return fixture->GetType() == b2Shape::e_edge && !fixture->IsSensor();
}

const b2PolygonShape& PolygonOf(const b2Fixture& fixture) {
  return *static_cast<const b2PolygonShape*>(fixture.GetShape());
}

b2Shape* ShapeIn(const b2Fixture& fixture) { return const_cast<b2Fixture&>(fixture).GetShape(); }

/// A body's pose in double precision: shapes far from the origin meet to a millimetre.
struct Pose {
  Vector2d shift{0, 0};
  double sine = 0, cosine = 1;

  Vector2d Turned(const Vector2d& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
  Vector2d TurnedBack(const Vector2d& v) const {
    return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x()};
  }
  Vector2d Out(const b2Vec2& local) const { return shift + Turned(FromB2(local).cast<double>()); }
  b2Vec2 In(const Vector2d& point) const { return ToB2(TurnedBack(point - shift).cast<float>()); }
};

/// Anchored shapes are compared in the world, those of any other body in its own frame.
Pose FrameOf(const b2Fixture& fixture) {
  const b2Body* body = const_cast<b2Fixture&>(fixture).GetBody();
  if (body->GetType() != b2_staticBody) return {};
  const b2Transform& pose = body->GetTransform();
  return {FromB2(pose.p).cast<double>(), static_cast<double>(pose.q.s),
          static_cast<double>(pose.q.c)};
}

SolidPolygon SolidOf(const b2Fixture& fixture) {
  const b2PolygonShape& polygon = PolygonOf(fixture);
  const Pose frame = FrameOf(fixture);
  SolidPolygon solid;
  solid.group = fixture.GetFilterData().groupIndex;
  for (int32 i = 0; i < polygon.m_count; ++i) {
    solid.points.push_back(frame.Out(polygon.m_vertices[i]));
  }
  return solid;
}

OutlineLine LineOf(const b2Fixture& fixture) {
  const auto& edge = *static_cast<const b2EdgeShape*>(fixture.GetShape());
  const Pose frame = FrameOf(fixture);
  return {frame.Out(edge.m_vertex1), frame.Out(edge.m_vertex2), fixture.GetFilterData().groupIndex};
}

/// Returns the direction of a neighbour of an edge with direction `along`. The engine lets a
/// contact lean over an end by up to 6 degrees if the outline does not rise there. So a neighbour
/// that goes on nearly straight is said to rise a little: by `rise`, to the left or right.
Vector2d Neighbour(const Vector2d& along, const Vector2d& next, double rise) {
  constexpr double kStraight = 0.1;  // sine: as much as the engine lets it lean
  const bool straight = std::fabs(Cross(along, next)) < kStraight && along.dot(next) > 0;
  return straight ? Vector2d(along + rise * Vector2d(-along.y(), along.x())) : next;
}

/// Returns the edge in the body's frame, with the shape's rim.
b2EdgeShape EngineEdge(const OutlineEdge& edge, const b2Fixture& fixture) {
  constexpr double kNeighbourRise = 1e-3;
  const Pose frame = FrameOf(fixture);
  const Vector2d along = (edge.to - edge.from).normalized();
  b2EdgeShape shape;
  shape.SetOneSided(frame.In(edge.from - Neighbour(along, edge.before, kNeighbourRise)),
                    frame.In(edge.from), frame.In(edge.to),
                    frame.In(edge.to + Neighbour(along, edge.after, -kNeighbourRise)));
  shape.m_radius = fixture.GetShape()->m_radius;
  return shape;
}

/// A disc around a shape, in some body's frame.
struct Round {
  b2Vec2 middle;
  float radius;  // m
};

Round RoundOf(const b2Fixture& fixture, const b2Transform& own, const b2Transform& there) {
  const b2Shape* shape = fixture.GetShape();
  if (shape->GetType() == b2Shape::e_circle) {
    const auto* circle = static_cast<const b2CircleShape*>(shape);
    return {b2MulT(own, b2Mul(there, circle->m_p)), circle->m_radius};
  }
  const b2PolygonShape& polygon = PolygonOf(fixture);
  float reach = 0;
  for (int32 i = 0; i < polygon.m_count; ++i) {
    reach = std::max(reach, b2DistanceSquared(polygon.m_vertices[i], polygon.m_centroid));
  }
  return {b2MulT(own, b2Mul(there, polygon.m_centroid)), std::sqrt(reach) + polygon.m_radius};
}

/// Returns true if the edge is too far from the disc for a contact.
bool IsFar(const b2EdgeShape& edge, const Round& round) {
  const b2Vec2 along = edge.m_vertex2 - edge.m_vertex1;
  const float share = b2Dot(round.middle - edge.m_vertex1, along) / b2Dot(along, along);
  const b2Vec2 nearest = edge.m_vertex1 + b2Clamp(share, 0.0f, 1.0f) * along;
  const float reach = round.radius + edge.m_radius + kEdgeSlack;
  return b2DistanceSquared(round.middle, nearest) > reach * reach;
}

b2Vec2 MiddleOf(const b2Shape& shape) {
  if (shape.GetType() == b2Shape::e_circle) return static_cast<const b2CircleShape&>(shape).m_p;
  if (shape.GetType() == b2Shape::e_polygon) {
    return static_cast<const b2PolygonShape&>(shape).m_centroid;
  }
  const auto& edge = static_cast<const b2EdgeShape&>(shape);
  return 0.5f * (edge.m_vertex1 + edge.m_vertex2);
}

/// Returns true if the middle of `other` is within the polygon: it has sunk in.
bool IsSunkIn(const b2Fixture& polygon, const b2Fixture& other) {
  const b2Vec2 local = MiddleOf(*other.GetShape());
  const b2Vec2 middle = b2Mul(const_cast<b2Fixture&>(other).GetBody()->GetTransform(), local);
  return polygon.TestPoint(middle);
}

/// Exchanges the roles of the two shapes.
void Swap(b2Manifold* manifold) {
  if (manifold->type != b2Manifold::e_circles) {
    manifold->type =
        manifold->type == b2Manifold::e_faceA ? b2Manifold::e_faceB : b2Manifold::e_faceA;
  }
  for (int32 i = 0; i < manifold->pointCount; ++i) {
    b2ContactFeature& id = manifold->points[i].id.cf;
    std::swap(id.indexA, id.indexB);
    std::swap(id.typeA, id.typeB);
  }
}

/// Copies the impulses of the same points, to start the solver with.
void TakeImpulses(const b2Manifold& from, b2Manifold* to) {
  for (int32 i = 0; i < to->pointCount; ++i) {
    b2ManifoldPoint& point = to->points[i];
    point.normalImpulse = point.tangentImpulse = 0;
    for (int32 j = 0; j < from.pointCount; ++j) {
      if (from.points[j].id.key != point.id.key) continue;
      point.normalImpulse = from.points[j].normalImpulse;
      point.tangentImpulse = from.points[j].tangentImpulse;
    }
  }
}

}  // namespace

void OutlineContacts::Find(const Scene& scene, const Composition& composition,
                           const BuiltScene& built) {
  first_.assign(scene.parts.size(), -1);
  shapes_.clear();
  // Anchored shapes with a skin are moved in, and have gaps between them.
  const double skin = static_cast<double>(scene.solver.skin);
  const double moved_in = skin > 0 ? 2 * (static_cast<double>(b2_polygonRadius) - skin) : 0;
  const double gap = static_cast<double>(b2_linearSlop);
  std::vector<b2Body*> anchored;
  for (std::size_t a = 0; a < composition.assemblies.size(); ++a) {
    const Assembly& assembly = composition.assemblies[a];
    b2Body* const body = built.bodies[a];
    const bool still = assembly.anchored && assembly.kinematic < 0;
    if (still && (anchored.empty() || anchored.back() != body)) anchored.push_back(body);
    if (!still) FindGroup({body}, body->IsBullet() || assembly.anchored ? gap + moved_in : gap);
  }
  std::sort(anchored.begin(), anchored.end());
  anchored.erase(std::unique(anchored.begin(), anchored.end()), anchored.end());
  FindGroup(anchored, gap + moved_in);
}

void OutlineContacts::FindGroup(const std::vector<b2Body*>& bodies, double gap) {
  std::vector<const b2Fixture*> fixtures;
  std::vector<const b2Fixture*> segments;
  for (b2Body* body : bodies) {
    for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext()) {
      if (PartOf(f) >= first_.size()) continue;
      if (IsSolid(f)) fixtures.push_back(f);
      if (IsSegment(f)) segments.push_back(f);
    }
  }
  std::sort(segments.begin(), segments.end(),
            [](const b2Fixture* x, const b2Fixture* y) { return PartOf(x) < PartOf(y); });
  FindSegments(segments, gap);
  if (fixtures.size() < 2) return;
  std::sort(fixtures.begin(), fixtures.end(), [](const b2Fixture* x, const b2Fixture* y) {
    return std::make_pair(PartOf(x), PieceOf(x)) < std::make_pair(PartOf(y), PieceOf(y));
  });
  std::vector<SolidPolygon> solids;
  for (const b2Fixture* f : fixtures) solids.push_back(SolidOf(*f));
  const std::vector<SolidOutline> outlines = OutlinesOf(solids, gap);
  for (std::size_t i = 0; i < fixtures.size();) {
    const std::size_t part = PartOf(fixtures[i]);
    std::size_t end = i;
    bool alone = true;
    for (; end < fixtures.size() && PartOf(fixtures[end]) == part; ++end) {
      alone = alone && outlines[end].alone;
    }
    if (!alone) first_[part] = static_cast<int>(shapes_.size());
    for (; i < end; ++i) {
      if (alone) continue;
      // Pieces that are no polygons have numbers, too.
      shapes_.resize(static_cast<std::size_t>(first_[part]) + PieceOf(fixtures[i]) + 1);
      Shape& shape = shapes_.back();
      shape.alone = outlines[i].alone;
      for (const OutlineEdge& edge : outlines[i].edges) {
        shape.edges.push_back(EngineEdge(edge, *fixtures[i]));
      }
    }
  }
}

void OutlineContacts::FindSegments(const std::vector<const b2Fixture*>& segments, double gap) {
  if (segments.size() < 2) return;
  std::vector<OutlineLine> lines;
  for (const b2Fixture* f : segments) lines.push_back(LineOf(*f));
  const std::vector<SolidOutline> outlines = LineOutlinesOf(lines, gap);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (outlines[i].alone) continue;
    first_[PartOf(segments[i])] = static_cast<int>(shapes_.size());
    Shape& shape = shapes_.emplace_back();
    shape.alone = false;
    for (const OutlineEdge& edge : outlines[i].edges) {
      shape.edges.push_back(EngineEdge(edge, *segments[i]));
    }
  }
}

const OutlineContacts::Shape* OutlineContacts::ShapeOf(const b2Fixture* fixture) const {
  const std::size_t part = PartOf(fixture);
  if (part >= first_.size() || first_[part] < 0) return nullptr;
  if (!IsSolid(fixture) && !IsSegment(fixture)) return nullptr;
  const Shape& shape = shapes_[static_cast<std::size_t>(first_[part]) + PieceOf(fixture)];
  return shape.alone ? nullptr : &shape;
}

/// Returns true if the side of the shape that the manifold names is part of its outline there.
bool OutlineContacts::Reachable(const Shape& shape, const b2Manifold& manifold,
                                const b2Transform& own, const b2Transform& other) {
  constexpr float kSameSide = 0.999f;
  for (const b2EdgeShape& edge : shape.edges) {
    b2Vec2 along = edge.m_vertex2 - edge.m_vertex1;
    const float length = along.Normalize();
    if (b2Dot(b2Vec2(along.y, -along.x), manifold.localNormal) < kSameSide) continue;
    for (int32 i = 0; i < manifold.pointCount; ++i) {
      const b2Vec2 point = b2MulT(own, b2Mul(other, manifold.points[i].localPoint));
      const float at = b2Dot(along, point - edge.m_vertex1);
      if (at >= -kEdgeSlack && at <= length + kEdgeSlack) return true;
    }
  }
  return false;
}

/// Finds the manifold of one of the shape's edges with the other shape that overlaps least, as the
/// engine does among the sides of a polygon. The shape is the first of the manifold's two.
bool OutlineContacts::Best(const Shape& shape, const b2Fixture& own, const Shape* other_shape,
                           const b2Fixture& other, b2Manifold* best) {
  const b2Transform& here = const_cast<b2Fixture&>(own).GetBody()->GetTransform();
  const b2Transform& there = const_cast<b2Fixture&>(other).GetBody()->GetTransform();
  const bool circle = other.GetType() == b2Shape::e_circle;
  const Round round = RoundOf(other, here, there);
  float least = -FLT_MAX;
  for (std::size_t i = 0; i < shape.edges.size(); ++i) {
    const b2EdgeShape& edge = shape.edges[i];
    if (IsFar(edge, round)) continue;
    b2Manifold manifold;
    if (circle) {
      b2CollideEdgeAndCircle(&manifold, &edge, here, static_cast<b2CircleShape*>(ShapeIn(other)),
                             there);
    } else {
      b2CollideEdgeAndPolygon(&manifold, &edge, here, &PolygonOf(other), there);
    }
    if (manifold.pointCount == 0) continue;
    const bool by_other = manifold.type == b2Manifold::e_faceB;
    if (by_other && other_shape != nullptr && !Reachable(*other_shape, manifold, there, here)) {
      continue;
    }
    b2WorldManifold in_world;
    in_world.Initialize(&manifold, here, edge.m_radius, there, other.GetShape()->m_radius);
    float overlap = FLT_MAX;
    for (int32 k = 0; k < manifold.pointCount; ++k) {
      overlap = std::min(overlap, in_world.separations[k]);
      manifold.points[k].id.cf.indexA |= static_cast<uint8>(i % kEdgeIds << 4);
    }
    if (overlap <= least) continue;
    least = overlap;
    *best = manifold;
  }
  return least > -FLT_MAX;
}

void OutlineContacts::Correct(b2Contact* contact, const b2Manifold& old) const {
  const b2Fixture *const a = contact->GetFixtureA(), *const b = contact->GetFixtureB();
  const Shape *const shape_a = ShapeOf(a), *const shape_b = ShapeOf(b);
  if (shape_a == nullptr && shape_b == nullptr) return;
  const auto has_sides = [](const b2Fixture* f) {
    return f->GetType() == b2Shape::e_polygon || f->GetType() == b2Shape::e_circle;
  };
  // The engine lets a chain's segments know their next ones; lone segments have none.
  const auto knows = [&](const b2Fixture* f, const Shape* shape) {
    return has_sides(f) || (IsSegment(f) && shape != nullptr);
  };
  if (!knows(a, shape_a) || !knows(b, shape_b)) return;
  b2Manifold* const manifold = contact->GetManifold();
  b2Manifold best;
  bool found = shape_a != nullptr && has_sides(b) && Best(*shape_a, *a, shape_b, *b, &best);
  if (!found && shape_b != nullptr && has_sides(a)) {
    found = Best(*shape_b, *b, shape_a, *a, &best);
    if (found) Swap(&best);
  }
  if (found) {
    TakeImpulses(old, &best);
    *manifold = best;
    return;
  }
  const bool sunk =
      (shape_a != nullptr && IsSunkIn(*a, *b)) || (shape_b != nullptr && IsSunkIn(*b, *a));
  if (sunk) return;
  manifold->pointCount = 0;
  contact->SetEnabled(false);
}

}  // namespace seam
