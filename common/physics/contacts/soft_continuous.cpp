/// SoftStep: chooses the contacts that need the engine's continuous collision. The engine looks
/// through its whole list of contacts after each impact.

#include <algorithm>
#include <cmath>

#include "common/physics/contacts/soft_step.h"
#include "common/physics/engine_members.h"

namespace seam {
namespace {

SEAM_REVEAL(ContactBefore, b2Contact*, b2Contact, m_prev);
SEAM_REVEAL(ContactAfter, b2Contact*, b2Contact, m_next);

/// m: bodies that have come nearer by less cannot have passed through each other, and overlap by
/// no more than the engine's contacts at rest.
constexpr float kNearerMin = b2_linearSlop;

float ReachOf(const b2Fixture& fixture, b2Vec2 centre) {
  const b2Shape& shape = *fixture.GetShape();
  if (shape.GetType() == b2Shape::e_circle) {
    return shape.m_radius + (static_cast<const b2CircleShape&>(shape).m_p - centre).Length();
  }
  if (shape.GetType() != b2Shape::e_polygon) return b2_maxFloat;
  const auto& polygon = static_cast<const b2PolygonShape&>(shape);
  float reach = 0;
  for (int i = 0; i < polygon.m_count; ++i) {
    reach = std::max(reach, (polygon.m_vertices[i] - centre).Length());
  }
  return reach + shape.m_radius;
}

b2Vec2 NormalOf(const b2Contact* contact) {
  const b2Manifold& manifold = *contact->GetManifold();
  const b2Fixture* const face =
      manifold.type == b2Manifold::e_faceA ? contact->GetFixtureA() : contact->GetFixtureB();
  return b2Mul(face->GetBody()->GetTransform().q, manifold.localNormal);
}

/// Returns an upper bound of the distance, m, by which a body of this reach has come nearer to
/// anything of the other one in the step.
float Nearer(b2Contact* contact, b2Body* body, b2Body* other, float reach) {
  const b2Sweep& a = body->*Member(BodySweep());
  const b2Sweep& b = other->*Member(BodySweep());
  const float turn = b.a - b.a0;
  const b2Vec2 way = (a.c - a.c0) - (b.c - b.c0) - b2Cross(turn, a.c - b.c);
  const float turned = std::fabs(a.a - a.a0 - turn) * reach;
  const bool faces = contact->IsTouching() && contact->GetManifold()->type != b2Manifold::e_circles;
  return turned + (faces ? std::fabs(b2Dot(way, NormalOf(contact))) : way.Length());
}

}  // namespace

void SoftStep::FindReaches() {
  reach_.assign(all_.size(), 0);
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const b2Vec2 centre = all_[i]->GetLocalCenter();
    for (b2Fixture* f = all_[i]->GetFixtureList(); f != nullptr; f = f->GetNext()) {
      reach_[i] = std::max(reach_[i], ReachOf(*f, centre));
    }
  }
}

/// True if the body can have passed through nothing that stands still. A bullet that passes through
/// it is found at the bullet.
bool SoftStep::IsSlow(std::size_t i) const {
  if (!all_[i]->IsAwake()) return true;
  const b2Sweep& sweep = all_[i]->*Member(BodySweep());
  const float turn = std::fabs(sweep.a - sweep.a0) * reach_[i];
  return index_[i] >= 0 && (sweep.c - sweep.c0).Length() + turn <= kNearerMin;
}

/// True if continuous collision has to look at a contact of the moving body `i`.
bool SoftStep::MayPass(std::size_t i, const b2ContactEdge& edge) const {
  b2Body* const body = all_[i];
  b2Body* const other = edge.other;
  if (!body->IsAwake() && (Moves(other) || !other->IsAwake())) return false;
  if (Moves(other) && !body->IsBullet()) return false;
  return index_[i] < 0 || Nearer(edge.contact, body, other, reach_[i]) > kNearerMin;
}

bool SoftStep::Narrow(bool driven) {
  narrowed_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    b2Body* const body = all_[i];
    if (!body->IsEnabled() || (!driven && IsSlow(i))) continue;
    for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
      if (!MayPass(i, *edge)) continue;
      b2Contact* const made = edge->contact;
      narrowed_.push_back({made, made->*Member(ContactBefore()), made->*Member(ContactAfter())});
      if (!Moves(edge->other)) continue;
      narrowed_.clear();  // a bullet may push others anywhere
      return true;
    }
  }
  if (narrowed_.empty()) return false;
  auto& manager = const_cast<b2ContactManager&>(world_->GetContactManager());
  first_contact_ = manager.m_contactList;
  b2Contact* before = nullptr;
  for (const Link& link : narrowed_) {
    link.made->*Member(ContactBefore()) = before;
    (before != nullptr ? before->*Member(ContactAfter()) : manager.m_contactList) = link.made;
    before = link.made;
  }
  before->*Member(ContactAfter()) = nullptr;
  return true;
}

void SoftStep::Widen() {
  if (narrowed_.empty()) return;
  auto& manager = const_cast<b2ContactManager&>(world_->GetContactManager());
  b2Contact* fresh = nullptr;  // the last of those that continuous collision has found
  b2Contact* c = manager.m_contactList;
  for (; c != narrowed_.front().made; c = c->GetNext()) fresh = c;
  for (const Link& link : narrowed_) {
    link.made->*Member(ContactBefore()) = link.before;
    link.made->*Member(ContactAfter()) = link.after;
  }
  (fresh != nullptr ? fresh->*Member(ContactAfter()) : manager.m_contactList) = first_contact_;
  first_contact_->*Member(ContactBefore()) = fresh;
}

}  // namespace seam
