#include "common/physics/world_shapes.h"

#include <algorithm>
#include <vector>

#include "common/physics/mass.h"
#include "common/physics/world_build.h"

namespace seam {
namespace {

/// Edges shorter than this are not moved in: the engine merges points at 2.5 mm. m
constexpr float kEdgeLeast = 0.01f;
/// A sharp corner's point moves in by at most this many times its edges' distance.
constexpr float kMiterMost = 5;

b2Vec2 InRoot(const Part& part, const Part& root, const Vec2& point) {
  return ToB2(ToRootFrame(part, root, point.cast<double>()).cast<float>());
}

std::vector<b2Vec2> PointsInRoot(const Part& part, const Part& root) {
  std::vector<b2Vec2> points;
  for (const Vec2& p : part.points) points.push_back(InRoot(part, root, p));
  return points;
}

/// Where a corner of two edges with these outward normals goes when both move in by `depth`.
b2Vec2 MovedIn(const b2Vec2& corner, const b2Vec2& before, const b2Vec2& after, float depth) {
  const float share = std::min(kMiterMost, 1 / std::max(1e-3f, 1 + b2Dot(before, after)));
  return corner - depth * share * (before + after);
}

/// Moves all edges in by `depth`; leaves a polygon that is too small for it as it is.
bool MoveIn(float depth, b2PolygonShape* polygon) {
  const int32 count = polygon->m_count;
  std::vector<b2Vec2> points;
  for (int32 i = 0; i < count; ++i) {
    points.push_back(MovedIn(polygon->m_vertices[i], polygon->m_normals[(i + count - 1) % count],
                             polygon->m_normals[i], depth));
  }
  for (int32 i = 0; i < count; ++i) {
    const b2Vec2 edge = points[static_cast<std::size_t>((i + 1) % count)] -
                        points[static_cast<std::size_t>(i)];
    const b2Vec2 was = polygon->m_vertices[(i + 1) % count] - polygon->m_vertices[i];
    if (b2Dot(edge, was) <= 0 || edge.Length() < kEdgeLeast) return false;
  }
  polygon->Set(points.data(), count);
  return true;
}

void SetSkin(float skin, bool guarded, b2PolygonShape* polygon) {
  if (skin <= 0) return;
  if (!guarded) {
    polygon->m_radius = skin;
  } else {
    MoveIn(b2_polygonRadius - skin, polygon);
  }
}

/// Chains collide on the right of the way along their points in the engine, on the left in a
/// scene: so that ground is written in reading order. The ends continue straight on.
void SetChain(const std::vector<b2Vec2>& points, float skin, b2ChainShape* chain) {
  std::vector<b2Vec2> p(points.rbegin(), points.rend());
  if (skin > 0) {
    const auto outward = [&](std::size_t segment) {
      b2Vec2 along = points[segment + 1] - points[segment];
      along.Normalize();
      return b2Vec2(-along.y, along.x);   // left of the way in a scene: open air
    };
    const std::size_t last = points.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      p[last - i] = MovedIn(points[i], outward(i == 0 ? 0 : i - 1),
                            outward(i == last ? last - 1 : i), b2_polygonRadius - skin);
    }
  }
  const b2Vec2 before = p[0] - (p[1] - p[0]);
  const b2Vec2 after = p.back() + (p.back() - p[p.size() - 2]);
  chain->CreateChain(p.data(), static_cast<int32>(p.size()), before, after);
}

}  // namespace

void AddFixture(const Part& part, const Part& root, float skin, bool guarded, b2Body* body) {
  b2PolygonShape polygon;
  b2CircleShape circle;
  b2ChainShape chain;
  b2FixtureDef def;
  switch (part.kind) {
    case ShapeKind::kBox:
      polygon.SetAsBox(part.size.x() / 2, part.size.y() / 2, InRoot(part, root, {0, 0}),
                       part.angle - root.angle);
      SetSkin(skin, guarded, &polygon);
      def.shape = &polygon;
      break;
    case ShapeKind::kCircle:
      // The engine gives circles no rim: with `skin` they get one, or they would rest in what
      // they lie on.
      circle.m_radius = part.radius + skin;
      circle.m_p = InRoot(part, root, {0, 0});
      def.shape = &circle;
      break;
    case ShapeKind::kPolygon: {
      const std::vector<b2Vec2> points = PointsInRoot(part, root);
      polygon.Set(points.data(), static_cast<int32>(points.size()));
      SetSkin(skin, guarded, &polygon);
      def.shape = &polygon;
      break;
    }
    case ShapeKind::kChain:
      SetChain(PointsInRoot(part, root), skin, &chain);
      def.shape = &chain;
      break;
  }
  def.density = 0;   // The mass is set once for the body: summing it per fixture is quadratic.
  def.friction = part.material.friction;
  def.restitution = part.material.restitution;
  def.userData.pointer = static_cast<std::uintptr_t>(part.id);
  def.filter.groupIndex = static_cast<int16>(part.group);
  body->CreateFixture(&def);
}

}  // namespace seam
