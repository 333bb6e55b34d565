/// ExactStep: finds islands, orders their bodies and chooses the solver.

#include <algorithm>
#include <limits>

#include "common/physics/engine_members.h"
#include "common/physics/exact/exact_step.h"

namespace seam {
namespace {

/// Multiplications of a factorisation above which contacts are relaxed.
constexpr long kDirectMost = 30000;
/// Multiplications of a tick, solves included, above which a heap is left to the engine or relaxed:
/// the larger of kSolveMost and the cost of kFactorsMost factorisations in each substep.
constexpr long kSolveMost = 800000, kFactorsMost = 20;
/// Number of contact points from which an island is a heap. A mechanism in contact with itself is
/// expensive, too, but is not left to the engine.
constexpr int kPointsOfHeap = 24;

}  // namespace

bool ExactStep::Gather(int first, Found* found) {
  found->slots.clear();
  found->mechanisms.clear();
  found->contacts.clear();
  bool awake = false, exact = true;
  const auto take = [&](int mechanism) {
    found->mechanisms.push_back(mechanism);
    const Mechanism& m = mechanisms_[static_cast<std::size_t>(mechanism)];
    exact = exact && m.exact;
    for (const int slot : m.slots) {
      Slot& s = slots_[static_cast<std::size_t>(slot)];
      s.island = first;
      if (Moves(s.body)) found->slots.push_back(slot);
    }
  };
  take(first);
  for (std::size_t i = 0; i < found->slots.size(); ++i) {
    b2Body* body = slots_[static_cast<std::size_t>(found->slots[i])].body;
    awake = awake || body->IsAwake();
    for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
      if (!Pushes(edge->contact)) continue;
      if (!Moves(edge->other)) {
        found->contacts.push_back(edge->contact);
        awake = awake || (edge->other->GetType() == b2_kinematicBody && edge->other->IsAwake());
        continue;
      }
      if (edge->contact->GetFixtureA()->GetBody() == body) found->contacts.push_back(edge->contact);
      const int slot = SlotOf(edge->other);
      Slot& other = slots_[static_cast<std::size_t>(slot)];
      if (other.island >= 0) continue;
      if (other.mechanism >= 0) {
        take(other.mechanism);
      } else {
        other.island = first;
        found->slots.push_back(slot);
      }
    }
  }
  return awake && exact && !found->slots.empty();
}

/// Orders bodies by their distance from one at the edge, so that neighbours are near each other.
/// Bodies with contacts come last, if possible: contacts change most, and the factors before them
/// are kept.
void ExactStep::Order(Found* found) {
  const std::size_t n = found->slots.size();
  for (std::size_t i = 0; i < n; ++i) {
    slots_[static_cast<std::size_t>(found->slots[i])].place = static_cast<int>(i);
  }
  if (near_.size() < n) near_.resize(n);
  for (std::vector<int>& near : near_) near.clear();
  const auto join = [&](int a, int b) {
    near_[static_cast<std::size_t>(a)].push_back(b);
    near_[static_cast<std::size_t>(b)].push_back(a);
  };
  const auto place = [&](int slot) {
    if (slot < 0) return -1;
    const Slot& s = slots_[static_cast<std::size_t>(slot)];
    return Moves(s.body) ? s.place : -1;
  };
  for (const int m : found->mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
      const int a = place(joint.slot_a), b = place(joint.slot_b);
      if (a >= 0 && b >= 0) join(a, b);
    }
  }
  for (const b2Contact* contact : found->contacts) {
    const int a = place(SlotOf(const_cast<b2Fixture*>(contact->GetFixtureA())->GetBody()));
    const int b = place(SlotOf(const_cast<b2Fixture*>(contact->GetFixtureB())->GetBody()));
    if (a >= 0 && b >= 0) join(a, b);
  }
  std::vector<int>& order = order_;
  std::vector<char>& seen = seen_;
  std::size_t start = 0;
  for (int pass = 0; pass < 2; ++pass) {
    seen.assign(n, 0);
    order.clear();
    const auto visit = [&](std::size_t i) {
      if (seen[i]) return;
      seen[i] = 1;
      order.push_back(static_cast<int>(i));
    };
    visit(start);
    for (std::size_t next = 0, k = 0; k < n; ++k) {
      if (k == order.size()) {  // parts connected only through anchored bodies
        while (seen[next]) ++next;
        visit(next);
      }
      for (const int other : near_[static_cast<std::size_t>(order[k])]) {
        visit(static_cast<std::size_t>(other));
      }
    }
    start = static_cast<std::size_t>(order.back());
  }
  seen.assign(n, 0);
  for (const b2Contact* contact : found->contacts) {
    for (const b2Fixture* fixture : {contact->GetFixtureA(), contact->GetFixtureB()}) {
      const int at = place(SlotOf(const_cast<b2Fixture*>(fixture)->GetBody()));
      if (at >= 0) seen[static_cast<std::size_t>(at)] = 1;
    }
  }
  std::size_t early = 0, late = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!seen[static_cast<std::size_t>(order[k])]) continue;
    early += n - 1 - k;
    late += k;
  }
  if (early > late) std::reverse(order.begin(), order.end());
  for (int& i : order) i = found->slots[static_cast<std::size_t>(i)];
  found->slots = order;
}

/// Returns a lower bound of the multiplications of a direct factorisation in any order. The k rows
/// of a body are coupled, so that the last of them is k wide, the one before k - 1; and a row
/// belongs to two bodies, that of a gear to four.
long ExactStep::LeastCost(const Found& found) {
  std::vector<int>& rows = order_;
  rows.assign(slots_.size(), 0);
  int ends = 2;
  const auto count = [&](int slot, int more) {
    if (slot >= 0) rows[static_cast<std::size_t>(slot)] += more;
  };
  for (const int m : found.mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
      count(joint.slot_a, RowCount(joint));
      count(joint.slot_b, RowCount(joint));
      ends = std::max(ends, EndsOf(joint));
    }
  }
  for (b2Contact* contact : found.contacts) {
    const int more = 2 * contact->GetManifold()->pointCount;
    count(SlotOf(contact->GetFixtureA()->GetBody()), more);
    count(SlotOf(contact->GetFixtureB()->GetBody()), more);
  }
  double sum = 0;
  for (const int slot : found.slots) {
    const double k = rows[static_cast<std::size_t>(slot)];
    sum += k * (k + 1) * (2 * k + 1) / 12;
  }
  return static_cast<long>(sum / ends);
}

bool ExactStep::IsHeap(const Found& found) {
  int points = 0;
  for (b2Contact* contact : found.contacts) points += contact->GetManifold()->pointCount;
  return points >= kPointsOfHeap;
}

/// Builds the island. Returns the cost of a direct factorisation, in multiplications.
long ExactStep::Build(Found* found, bool relaxed) {
  Order(found);
  if (relaxed) {
    std::stable_sort(found->slots.begin(), found->slots.end(), [this](int a, int b) {
      return slots_[static_cast<std::size_t>(a)].mechanism <
             slots_[static_cast<std::size_t>(b)].mechanism;
    });
  }
  if (!found->island) found->island = std::make_unique<ExactIsland>();
  ExactIsland& island = *found->island;
  island.bodies.clear();
  island.joints.clear();
  island.contacts.clear();
  for (std::size_t i = 0; i < found->slots.size(); ++i) {
    Slot& slot = slots_[static_cast<std::size_t>(found->slots[i])];
    slot.place = static_cast<int>(i);
    ExactBody q;
    q.body = slot.body;
    q.slot = found->slots[i];
    q.group = slot.mechanism;
    q.im = static_cast<double>(slot.body->*Member(BodyInverseMass()));
    q.inertia = static_cast<double>(slot.body->*Member(BodyInertia()));
    q.ii = 1 / q.inertia;
    island.bodies.push_back(q);
  }
  const auto place = [&](b2Body* body) {
    if (Moves(body)) return slots_[static_cast<std::size_t>(SlotOf(body))].place;
    for (std::size_t i = found->slots.size(); i < island.bodies.size(); ++i) {
      if (island.bodies[i].body == body) return static_cast<int>(i);
    }
    ExactBody q;
    q.body = body;
    island.bodies.push_back(q);
    return static_cast<int>(island.bodies.size()) - 1;
  };
  for (const int m : found->mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
      b2Body* a = joint.made->GetBodyA();
      b2Body* b = joint.made->GetBodyB();
      if (!Moves(a) && !Moves(b)) continue;
      const b2Vec2 at_a = joint.anchor_a - a->GetLocalCenter();
      const b2Vec2 at_b = joint.anchor_b - b->GetLocalCenter();
      ExactIsland::Held held;
      held.joint = &joint;
      held.ends = {place(a),
                   place(b),
                   static_cast<double>(at_a.x),
                   static_cast<double>(at_a.y),
                   static_cast<double>(at_b.x),
                   static_cast<double>(at_b.y)};
      if (joint.type == e_gearJoint) {
        auto& gear = *static_cast<b2GearJoint*>(joint.made);
        held.ends.base_a = place(gear.GetJoint1()->GetBodyA());
        held.ends.base_b = place(gear.GetJoint2()->GetBodyA());
      }
      island.joints.push_back(held);
    }
  }
  for (b2Contact* made : found->contacts) {
    ExactContact contact;
    contact.made = made;
    contact.a = place(made->GetFixtureA()->GetBody());
    contact.b = place(made->GetFixtureB()->GetBody());
    contact.count = made->GetManifold()->pointCount;
    island.contacts.push_back(contact);
  }
  LoadPoses(found);
  const long cost = island.Shape(relaxed, kDirectMost);
  island.work_most = std::numeric_limits<long>::max();
  if (solver_.joints == JointSolving::kAuto && !relaxed && IsHeap(*found)) {
    island.work_most =
        std::max(kSolveMost / solver_.substeps, kFactorsMost * cost * long{solver_.joint_substeps});
  }
  if (relaxed || cost <= kDirectMost) return cost;
  if (solver_.joints == JointSolving::kAuto) {
    found->island.reset();  // left to the engine
  } else {
    Build(found, true);
  }
  return cost;
}

void ExactStep::Sign(const Found& found, std::vector<const void*>* sign) const {
  sign->clear();
  const auto number = [&](int n) {
    sign->push_back(reinterpret_cast<const void*>(std::intptr_t{n}));
  };
  number(found.relaxed ? 1 : 0);
  number(static_cast<int>(found.slots.size()));
  for (const int slot : found.slots) number(slot);
  for (b2Contact* contact : found.contacts) {
    sign->push_back(contact);
    sign->push_back(contact->GetFixtureA());
    sign->push_back(contact->GetFixtureB());
    number(contact->GetManifold()->pointCount);
  }
  for (const int m : found.mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
      number(RowCount(joint) * 4 + (joint.near_lower ? 2 : 0) + (joint.near_upper ? 1 : 0));
    }
  }
}

/// Makes the island for the gathered bodies, unless the last one has the same contents.
void ExactStep::Prepare(float h, Found* found) {
  for (const int m : found->mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      LookAt(static_cast<double>(h), &joints_[static_cast<std::size_t>(j)]);
    }
  }
  Sign(*found, &sign_);
  if (sign_ == found->sign) return;
  found->sign = sign_;
  if (found->relaxed) {
    Build(found, true);
    return;
  }
  // Ordering and shaping a heap in each step would cost many times the engine's step.
  if (solver_.joints == JointSolving::kAuto && LeastCost(*found) > kDirectMost) {
    found->island.reset();
    return;
  }
  Build(found, false);
}

}  // namespace seam
