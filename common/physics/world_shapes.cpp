#include "common/physics/world_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/physics/world_build.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

/// Edges shorter than this are not moved in, m: the engine merges points at 2.5 mm.
constexpr float kMovedEdgeMin = 0.01f;
/// Limit of a sharp corner's move, as a multiple of its edges' move.
constexpr float kMiterMax = 5;

b2Vec2 InRoot(const Part& part, const Part& root, const Vec2& point) {
  return ToB2(ToRootFrame(part, root, point.cast<double>()).cast<float>());
}

std::vector<b2Vec2> PointsInRoot(const Part& part, const Part& root) {
  std::vector<b2Vec2> points;
  for (const Vec2& p : part.points) points.push_back(InRoot(part, root, p));
  return points;
}

/// Returns the new position of a corner of two edges with these outward normals, both moved in by
/// `depth`.
b2Vec2 MovedIn(const b2Vec2& corner, const b2Vec2& before, const b2Vec2& after, float depth) {
  const float share = std::min(kMiterMax, 1 / std::max(1e-3f, 1 + b2Dot(before, after)));
  return corner - depth * share * (before + after);
}

/// Moves all edges in by `depth`. False, and unchanged, if the polygon is too small for it.
bool MoveIn(float depth, b2PolygonShape* polygon) {
  const int32 count = polygon->m_count;
  std::vector<b2Vec2> points;
  for (int32 i = 0; i < count; ++i) {
    points.push_back(MovedIn(polygon->m_vertices[i], polygon->m_normals[(i + count - 1) % count],
                             polygon->m_normals[i], depth));
  }
  for (int32 i = 0; i < count; ++i) {
    const b2Vec2 edge =
        points[static_cast<std::size_t>((i + 1) % count)] - points[static_cast<std::size_t>(i)];
    const b2Vec2 was = polygon->m_vertices[(i + 1) % count] - polygon->m_vertices[i];
    if (b2Dot(edge, was) <= 0 || edge.Length() < kMovedEdgeMin) return false;
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

/// In the engine chains collide on the right of their direction, in a scene on the left, so that
/// ground is written in reading order. The ends continue straight on.
void SetChain(const std::vector<b2Vec2>& points, float skin, b2ChainShape* chain) {
  std::vector<b2Vec2> p(points.rbegin(), points.rend());
  if (skin > 0) {
    const auto outward = [&](std::size_t segment) {
      b2Vec2 along = points[segment + 1] - points[segment];
      along.Normalize();
      return b2Vec2(-along.y, along.x);  // left of the direction in a scene: open air
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

/// Adds shapes as a part's pieces, in the order of the calls.
class Pieces {
 public:
  Pieces(const Part& part, b2Body* body) : body_(body) {
    def_.density = 0;  // The mass is set once for the body: summing it per fixture is quadratic.
    def_.friction = part.material.friction;
    def_.restitution = part.material.restitution;
    def_.userData.pointer = static_cast<std::uintptr_t>(part.id);
    def_.filter.groupIndex = static_cast<int16>(part.filter.group);
    def_.filter.categoryBits = part.filter.category;
    def_.filter.maskBits = part.filter.mask;
  }
  void Add(const b2Shape& shape) {
    def_.shape = &shape;
    body_->CreateFixture(&def_);
    def_.userData.pointer += std::uintptr_t{1} << 32;
  }

 private:
  b2Body* body_;
  b2FixtureDef def_;
};

/// Adds a polygon of convex points in order. More than the engine's eight are cut in halves, so
/// that no piece is a sliver.
void AddPolygon(const std::vector<b2Vec2>& points, float skin, bool guarded, Pieces* pieces) {
  if (points.size() > b2_maxPolygonVertices) {
    const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
    AddPolygon({points.begin(), middle + 1}, skin, guarded, pieces);
    std::vector<b2Vec2> rest(middle, points.end());
    rest.push_back(points[0]);
    AddPolygon(rest, skin, guarded, pieces);
    return;
  }
  b2PolygonShape polygon;
  polygon.Set(points.data(), static_cast<int32>(points.size()));
  SetSkin(skin, guarded, &polygon);
  pieces->Add(polygon);
}

/// Adds a circle. The engine gives circles no rim; with `skin` they get one, or they would sink
/// into the surface below.
void AddCircle(const b2Vec2& centre, float radius, float skin, Pieces* pieces) {
  b2CircleShape circle;
  circle.m_radius = radius + skin;
  circle.m_p = centre;
  pieces->Add(circle);
}

/// Adds two circles and a box between them, with the rims aligned.
void AddCapsule(const Part& part, const Part& root, float skin, bool guarded, Pieces* pieces) {
  const b2Vec2 first = InRoot(part, root, part.points[0]);
  const b2Vec2 last = InRoot(part, root, part.points[1]);
  AddCircle(first, part.radius, skin, pieces);
  AddCircle(last, part.radius, skin, pieces);
  const float rim = skin > 0 && !guarded ? skin : b2_polygonRadius;
  const b2Vec2 along = last - first;
  b2PolygonShape box;
  box.SetAsBox(along.Length() / 2, part.radius + skin - rim, 0.5f * (first + last),
               std::atan2(along.y, along.x));
  box.m_radius = rim;
  pieces->Add(box);
}

using Copied = std::variant<b2CircleShape, b2PolygonShape, b2EdgeShape>;

std::optional<Copied> CopyOf(const b2Shape& shape) {
  switch (shape.GetType()) {
    case b2Shape::e_circle: return static_cast<const b2CircleShape&>(shape);
    case b2Shape::e_polygon: return static_cast<const b2PolygonShape&>(shape);
    case b2Shape::e_edge: return static_cast<const b2EdgeShape&>(shape);
    default: return std::nullopt;  // a chain owns its points
  }
}

}  // namespace

void AddFixture(const Part& part, const Part& root, float skin, bool guarded, b2Body* body) {
  Pieces pieces(part, body);
  switch (part.kind) {
    case ShapeKind::kBox: {
      b2PolygonShape polygon;
      polygon.SetAsBox(part.size.x() / 2, part.size.y() / 2, InRoot(part, root, {0, 0}),
                       part.angle - root.angle);
      SetSkin(skin, guarded, &polygon);
      pieces.Add(polygon);
      break;
    }
    case ShapeKind::kCircle:
      AddCircle(InRoot(part, root, {0, 0}), part.radius, skin, &pieces);
      break;
    case ShapeKind::kCapsule: AddCapsule(part, root, skin, guarded, &pieces); break;
    case ShapeKind::kPolygon: AddPolygon(PointsInRoot(part, root), skin, guarded, &pieces); break;
    case ShapeKind::kChain: {
      b2ChainShape chain;
      SetChain(PointsInRoot(part, root), skin, &chain);
      pieces.Add(chain);
      break;
    }
    case ShapeKind::kSegment: {
      const std::vector<b2Vec2> ends = PointsInRoot(part, root);
      b2EdgeShape edge;
      edge.SetTwoSided(ends[0], ends[1]);
      pieces.Add(edge);
      break;
    }
  }
}

void ReadyFixtures::Take(b2Body* from) {
  fixtures_.clear();
  for (b2Fixture* f = from->GetFixtureList(); f != nullptr; f = f->GetNext()) {
    const std::optional<Copied> shape = CopyOf(*f->GetShape());
    if (!shape) {
      fixtures_.clear();
      return;
    }
    b2FixtureDef def;
    def.friction = f->GetFriction();
    def.restitution = f->GetRestitution();
    def.restitutionThreshold = f->GetRestitutionThreshold();
    def.density = f->GetDensity();
    def.isSensor = f->IsSensor();
    def.filter = f->GetFilterData();
    def.userData = f->GetUserData();
    fixtures_.push_back({def, *shape});
  }
  std::reverse(fixtures_.begin(), fixtures_.end());  // the engine's list begins with the last
}

void ReadyFixtures::Give(b2Body* to) const {
  for (const Fixture& fixture : fixtures_) {
    b2FixtureDef def = fixture.def;
    def.shape =
        std::visit([](const auto& shape) -> const b2Shape* { return &shape; }, fixture.shape);
    to->CreateFixture(&def);
  }
}

}  // namespace seam
