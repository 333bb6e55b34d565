#include "common/physics/contact_order.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "common/physics/reveal.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace {

SEAM_REVEAL(Flags, uint32, b2Contact, m_flags);
SEAM_REVEAL(Before, b2Contact*, b2Contact, m_prev);
SEAM_REVEAL(After, b2Contact*, b2Contact, m_next);
SEAM_REVEAL(EdgeA, b2ContactEdge, b2Contact, m_nodeA);
SEAM_REVEAL(EdgeB, b2ContactEdge, b2Contact, m_nodeB);
SEAM_REVEAL(EdgesOfBody, b2ContactEdge*, b2Body, m_contactList);

/// A bit of b2Contact::m_flags that the engine leaves alone: its place is decided.
constexpr uint32 kOrdered = 0x80000000u;

using ShapeKey = std::tuple<std::uint32_t, std::uint32_t, int32>;
using ContactKey = std::pair<ShapeKey, ShapeKey>;

ShapeKey KeyOf(const b2Fixture* fixture, int32 child) {
  return {PartOf(fixture), PieceOf(fixture), child};
}

/// The engine exchanges the two shapes of a contact by their types.
ContactKey Ordered(const ShapeKey& a, const ShapeKey& b) {
  return {std::min(a, b), std::max(a, b)};
}

b2ContactManager& ManagerOf(b2World* world) {
  return const_cast<b2ContactManager&>(world->GetContactManager());
}

/// What the broad phase has found: takes the place of the engine's contact manager there.
struct Found {
  struct Pair {
    ContactKey key;
    void *a, *b;
  };
  std::vector<Pair> pairs;

  void AddPair(void* a, void* b) {
    const auto* x = static_cast<const b2FixtureProxy*>(a);
    const auto* y = static_cast<const b2FixtureProxy*>(b);
    if (x->fixture->GetBody() == y->fixture->GetBody()) return;
    pairs.push_back(
        {Ordered(KeyOf(x->fixture, x->childIndex), KeyOf(y->fixture, y->childIndex)), a, b});
  }
};

/// Marks those that are not yet: they stand first in the list.
std::vector<b2Contact*> TakeNew(b2World* world) {
  std::vector<b2Contact*> fresh;
  b2Contact* c = world->GetContactList();
  for (; c != nullptr && (c->*Member(Flags()) & kOrdered) == 0; c = c->GetNext()) {
    c->*Member(Flags()) |= kOrdered;
    fresh.push_back(c);
  }
  return fresh;
}

void Unlink(b2ContactEdge* edge, b2Body* body) {
  if (edge->prev != nullptr) edge->prev->next = edge->next;
  if (edge->next != nullptr) edge->next->prev = edge->prev;
  if (body->*Member(EdgesOfBody()) == edge) body->*Member(EdgesOfBody()) = edge->next;
}

void LinkFirst(b2ContactEdge* edge, b2Body* body) {
  edge->prev = nullptr;
  edge->next = body->*Member(EdgesOfBody());
  if (edge->next != nullptr) edge->next->prev = edge;
  body->*Member(EdgesOfBody()) = edge;
}

void Unlink(b2Contact* c, b2ContactManager* manager) {
  b2Contact* const before = c->*Member(Before());
  b2Contact* const after = c->*Member(After());
  if (before != nullptr) before->*Member(After()) = after;
  if (after != nullptr) after->*Member(Before()) = before;
  if (manager->m_contactList == c) manager->m_contactList = after;
  Unlink(&(c->*Member(EdgeA())), c->GetFixtureA()->GetBody());
  Unlink(&(c->*Member(EdgeB())), c->GetFixtureB()->GetBody());
}

void LinkFirst(b2Contact* c, b2ContactManager* manager) {
  c->*Member(Before()) = nullptr;
  c->*Member(After()) = manager->m_contactList;
  if (manager->m_contactList != nullptr) manager->m_contactList->*Member(Before()) = c;
  manager->m_contactList = c;
  LinkFirst(&(c->*Member(EdgeA())), c->GetFixtureA()->GetBody());
  LinkFirst(&(c->*Member(EdgeB())), c->GetFixtureB()->GetBody());
}

}  // namespace

void FindContactsInOrder(b2World* world) {
  b2ContactManager& manager = ManagerOf(world);
  Found found;
  manager.m_broadPhase.UpdatePairs(&found);
  std::sort(found.pairs.begin(), found.pairs.end(),
            [](const Found::Pair& x, const Found::Pair& y) { return x.key < y.key; });
  for (std::size_t i = 0; i < found.pairs.size(); ++i) {
    const Found::Pair& pair = found.pairs[i];
    if (i == 0 || found.pairs[i - 1].key < pair.key) manager.AddPair(pair.a, pair.b);
  }
  TakeNew(world);
}

void OrderNewContacts(b2World* world) {
  const std::vector<b2Contact*> fresh = TakeNew(world);
  if (fresh.size() < 2) return;
  std::vector<std::pair<ContactKey, b2Contact*>> order;
  order.reserve(fresh.size());
  for (b2Contact* c : fresh) {
    order.emplace_back(Ordered(KeyOf(c->GetFixtureA(), c->GetChildIndexA()),
                               KeyOf(c->GetFixtureB(), c->GetChildIndexB())),
                       c);
  }
  std::sort(order.begin(), order.end());
  b2ContactManager& manager = ManagerOf(world);
  for (b2Contact* c : fresh) Unlink(c, &manager);
  for (const auto& [key, c] : order) LinkFirst(c, &manager);
}

}  // namespace seam
