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
SEAM_REVEAL(ProxiesOfFixture, int32, b2Fixture, m_proxyCount);
SEAM_REVEAL(Tree, b2DynamicTree, b2BroadPhase, m_tree);
SEAM_REVEAL(MovedCount, int32, b2BroadPhase, m_moveCount);

/// A bit of b2Contact::m_flags that the engine does not use: the contact is in order already.
constexpr uint32 kOrdered = 0x80000000u;

using ShapeKey = std::tuple<std::uint32_t, std::uint32_t, int32>;
using ContactKey = std::pair<ShapeKey, ShapeKey>;

ShapeKey KeyOf(const b2Fixture* fixture, int32 child) {
  return {PartOf(fixture), PieceOf(fixture), child};
}

/// Sorts the key, because the engine may swap the two shapes of a contact by type.
ContactKey Ordered(const ShapeKey& a, const ShapeKey& b) {
  return {std::min(a, b), std::max(a, b)};
}

b2ContactManager& ManagerOf(b2World* world) {
  return const_cast<b2ContactManager&>(world->GetContactManager());
}

/// Shapes of which the boxes in the engine's tree overlap.
struct Pair {
  ContactKey key;
  b2FixtureProxy *a, *b;
};

struct Shape {
  b2AABB box;
  b2FixtureProxy* proxy;
};

bool BeginsLeft(const Shape& x, const Shape& y) { return x.box.lowerBound.x < y.box.lowerBound.x; }

/// Adds the pairs of `shape` with those of `others`, which are sorted, from index `from` on that
/// begin within its range of x.
void Sweep(const Shape& shape, const std::vector<Shape>& others, std::size_t from,
           std::vector<Pair>* pairs) {
  const b2AABB& box = shape.box;
  const b2Fixture* fixture = shape.proxy->fixture;
  for (std::size_t i = from; i < others.size(); ++i) {
    const Shape& other = others[i];
    if (other.box.lowerBound.x > box.upperBound.x) break;
    if (other.box.lowerBound.y > box.upperBound.y || box.lowerBound.y > other.box.upperBound.y) {
      continue;
    }
    if (other.proxy->fixture->GetBody() == fixture->GetBody()) continue;
    // As in the engine: the older proxy comes first.
    const bool first = shape.proxy->proxyId < other.proxy->proxyId;
    pairs->push_back({Ordered(KeyOf(fixture, shape.proxy->childIndex),
                              KeyOf(other.proxy->fixture, other.proxy->childIndex)),
                      first ? shape.proxy : other.proxy, first ? other.proxy : shape.proxy});
  }
}

/// Returns the pairs with at least one of `moving`. Requires both sorted.
std::vector<Pair> SweepAll(const std::vector<Shape>& moving, const std::vector<Shape>& resting) {
  std::vector<Pair> pairs;
  std::size_t m = 0, r = 0;
  while (m < moving.size()) {
    if (r < resting.size() && BeginsLeft(resting[r], moving[m])) {
      Sweep(resting[r++], moving, m, &pairs);
    } else {
      Sweep(moving[m], moving, m + 1, &pairs);
      Sweep(moving[m], resting, r, &pairs);
      ++m;
    }
  }
  return pairs;
}

/// Marks and returns the unmarked contacts, which are first in the list.
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

/// The engine would query its tree for every shape. Here all shapes are new, and a sweep along x
/// finds the same pairs; it is cheap unless the shapes form one tower.
void FindContactsInOrder(b2World* world) {
  b2ContactManager& manager = ManagerOf(world);
  std::vector<Shape> moving, resting;
  for (b2Body* body = world->GetBodyList(); body != nullptr; body = body->GetNext()) {
    if (!body->IsEnabled()) continue;
    std::vector<Shape>& shapes = body->GetType() == b2_dynamicBody ? moving : resting;
    for (b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext()) {
      for (int32 i = 0; i < f->*Member(ProxiesOfFixture()); ++i) {
        b2FixtureProxy* proxy = &(f->*Member(Proxies()))[i];
        shapes.push_back({manager.m_broadPhase.GetFatAABB(proxy->proxyId), proxy});
        (manager.m_broadPhase.*Member(Tree())).ClearMoved(proxy->proxyId);
      }
    }
  }
  manager.m_broadPhase.*Member(MovedCount()) = 0;
  std::sort(moving.begin(), moving.end(), BeginsLeft);
  std::sort(resting.begin(), resting.end(), BeginsLeft);
  std::vector<Pair> pairs = SweepAll(moving, resting);
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.key < y.key; });
  for (const Pair& pair : pairs) manager.AddPair(pair.a, pair.b);
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

void FindNewContactsInOrder(b2World* world) {
  ManagerOf(world).FindNewContacts();
  OrderNewContacts(world);
}

}  // namespace seam
