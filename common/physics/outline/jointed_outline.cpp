/// OutlineContacts: decks of several moving bodies. Their poses change, so the outline is found at
/// each contact, of the few shapes that the rider is near.

#include "common/physics/outline/engine_outline.h"
#include "common/physics/outline/outline_contacts.h"

namespace seam {
namespace {

bool IsJointed(const b2Body& body, const b2Body& other) {
  for (const b2JointEdge* edge = body.GetJointList(); edge != nullptr; edge = edge->next) {
    if (edge->other == &other && !edge->joint->GetCollideConnected()) return true;
  }
  return false;
}

/// The points of a contact on the surface of one of its shapes, m.
struct SurfacePoints {
  b2Vec2 points[b2_maxManifoldPoints];
  int32 count = 0;
};

SurfacePoints PointsOn(const b2Fixture& fixture, const b2Contact& contact) {
  b2WorldManifold in_world;
  contact.GetWorldManifold(&in_world);
  const float side = contact.GetFixtureA() == &fixture ? -0.5f : 0.5f;  // the normal is out of A
  SurfacePoints on;
  on.count = contact.GetManifold()->pointCount;
  for (int32 i = 0; i < on.count; ++i) {
    on.points[i] = in_world.points[i] + side * in_world.separations[i] * in_world.normal;
  }
  return on;
}

/// True if one of the points is within the polygon, or at it within the rims of two shapes.
bool IsAt(const b2Fixture& polygon, const SurfacePoints& on) {
  constexpr float kNear = 2 * b2_polygonRadius + b2_linearSlop;
  const b2PolygonShape& shape = PolygonOf(polygon);
  const b2Transform& pose = const_cast<b2Fixture&>(polygon).GetBody()->GetTransform();
  for (int32 i = 0; i < on.count; ++i) {
    const b2Vec2 point = b2MulT(pose, on.points[i]);
    bool inside = true;
    for (int32 k = 0; k < shape.m_count && inside; ++k) {
      inside = b2Dot(shape.m_normals[k], point - shape.m_vertices[k]) <= kNear;
    }
    if (inside) return true;
  }
  return false;
}

FramePose PoseIn(const b2Transform& frame, const b2Transform& pose) {
  const b2Transform there = b2MulT(frame, pose);
  return {FromB2(there.p).cast<double>(), static_cast<double>(there.q.s),
          static_cast<double>(there.q.c)};
}

}  // namespace

bool OutlineContacts::FindJointed(const b2Contact& contact, const b2Fixture& own,
                                  const b2Fixture& other, Shape* shape) {
  b2Body* const deck = const_cast<b2Fixture&>(own).GetBody();
  b2Body* const rider = const_cast<b2Fixture&>(other).GetBody();
  if (deck->GetJointList() == nullptr || !IsSolid(&own)) return false;
  if (deck->GetType() != b2_dynamicBody || rider->GetType() != b2_dynamicBody) return false;
  std::vector<SolidPolygon> solids;
  SurfacePoints on;
  for (b2ContactEdge* edge = rider->GetContactList(); edge != nullptr; edge = edge->next) {
    if (edge->other == deck || !IsJointed(*deck, *edge->other)) continue;
    const b2Contact& beside = *edge->contact;
    const b2Fixture* const next =
        beside.GetFixtureA()->GetBody() == rider ? beside.GetFixtureB() : beside.GetFixtureA();
    if (!IsSolid(next)) continue;
    if (solids.empty()) {
      on = PointsOn(own, contact);
      solids.push_back(SolidOf(own, {}));
    }
    if (!IsAt(*next, on)) continue;
    const b2Transform& there = edge->other->GetTransform();
    solids.push_back(SolidOf(*next, PoseIn(deck->GetTransform(), there)));
  }
  if (solids.size() < 2) return false;
  for (const b2Fixture* f = deck->GetFixtureList(); f != nullptr; f = f->GetNext()) {
    if (f != &own && IsSolid(f)) solids.push_back(SolidOf(*f, {}));
  }
  const SolidOutline outline = FirstOutline(solids, b2_linearSlop);
  shape->alone = outline.alone;
  for (const OutlineEdge& edge : outline.edges) shape->edges.push_back(EngineEdge(edge, own, {}));
  return !outline.alone;
}

}  // namespace seam
