#include "common/physics/exact/exact_step.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/physics/reveal.h"

namespace seam {
namespace {

SEAM_REVEAL(BodyFlags, uint16, b2Body, m_flags);
SEAM_REVEAL(BodyPose, b2Transform, b2Body, m_xf);
SEAM_REVEAL(BodySweep, b2Sweep, b2Body, m_sweep);
SEAM_REVEAL(BodyVelocity, b2Vec2, b2Body, m_linearVelocity);
SEAM_REVEAL(BodySpin, float, b2Body, m_angularVelocity);
SEAM_REVEAL(BodyForce, b2Vec2, b2Body, m_force);
SEAM_REVEAL(BodyTorque, float, b2Body, m_torque);
SEAM_REVEAL(BodyInverseMass, float, b2Body, m_invMass);
SEAM_REVEAL(BodyInverseInertia, float, b2Body, m_invI);
SEAM_REVEAL(BodyInertia, float, b2Body, m_I);
SEAM_REVEAL(BodySleepTime, float, b2Body, m_sleepTime);
SEAM_REVEAL(ContactFlags, uint32, b2Contact, m_flags);
SEAM_REVEAL(NewContacts, bool, b2World, m_newContacts);
SEAM_REVEAL(Locked, bool, b2World, m_locked);
SEAM_REVEAL(LastInverseStep, float, b2World, m_inv_dt0);
SEAM_REVEAL(StepComplete, bool, b2World, m_stepComplete);

struct SyncFixtures {
  using Type = void (b2Body::*)();
  friend Type Member(SyncFixtures);
};
template struct Reveal<SyncFixtures, &b2Body::SynchronizeFixtures>;
struct EngineSolve {
  using Type = void (b2World::*)(const b2TimeStep&);
  friend Type Member(EngineSolve);
};
template struct Reveal<EngineSolve, &b2World::Solve>;
struct EngineSolveToi {
  using Type = void (b2World::*)(const b2TimeStep&);
  friend Type Member(EngineSolveToi);
};
template struct Reveal<EngineSolveToi, &b2World::SolveTOI>;

// The engine's own bits, which have no public names (b2_body.h, b2_contact.h).
constexpr uint16 kBodyAwake = 0x0002, kBodyAutoSleep = 0x0004, kBodyEnabled = 0x0020;
constexpr uint32 kContactEnabled = 0x0004;

/// Multiplications of one factorisation above which contacts are relaxed.
constexpr long kDirectMost = 30000;

bool Pushes(const b2Contact* contact) {
  return contact->IsTouching() && contact->IsEnabled() && !contact->GetFixtureA()->IsSensor() &&
         !contact->GetFixtureB()->IsSensor();
}

bool Moves(const b2Body* body) { return body->GetType() == b2_dynamicBody; }

void ReadPose(b2Body* body, ExactBody* q) {
  const b2Sweep& sweep = body->*Member(BodySweep());
  q->x = static_cast<double>(sweep.c.x);
  q->y = static_cast<double>(sweep.c.y);
  q->a = static_cast<double>(sweep.a);
  const b2Vec2& v = body->GetLinearVelocity();
  q->vx = static_cast<double>(v.x);
  q->vy = static_cast<double>(v.y);
  q->w = static_cast<double>(body->GetAngularVelocity());
}

}  // namespace

ExactStep::ExactStep(const Solver& solver, b2World* world, const BuiltScene& built)
    : solver_(solver), world_(world) {
  for (const MovingBody& m : built.moving) {
    slots_.emplace_back();
    slots_.back().body = m.body;
  }
  for (b2Joint* made : built.joints) {
    if (made == nullptr) continue;
    joints_.push_back(ReadJoint(made));
    joints_.back().slot_a = IndexOf(made->GetBodyA());
    joints_.back().slot_b = IndexOf(made->GetBodyB());
  }
  for (const b2Body* body : built.bodies) {
    paths_ = paths_ || (body->GetType() == b2_kinematicBody &&
                        const_cast<b2Body*>(body)->GetUserData().pointer == 0);
  }
  FindMechanisms();
}

ExactStep::~ExactStep() = default;

void ExactStep::FindMechanisms() {
  std::vector<std::vector<int>> joined(slots_.size());  // joints, by slot
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    for (const int slot : {joints_[j].slot_a, joints_[j].slot_b}) {
      if (slot >= 0) joined[static_cast<std::size_t>(slot)].push_back(static_cast<int>(j));
    }
  }
  std::vector<char> taken(joints_.size(), 0);
  for (std::size_t first = 0; first < slots_.size(); ++first) {
    if (slots_[first].mechanism >= 0 || joined[first].empty()) continue;
    const int index = static_cast<int>(mechanisms_.size());
    mechanisms_.emplace_back();
    Mechanism& mechanism = mechanisms_.back();
    mechanism.slots.push_back(static_cast<int>(first));
    slots_[first].mechanism = index;
    for (std::size_t i = 0; i < mechanism.slots.size(); ++i) {
      for (const int j : joined[static_cast<std::size_t>(mechanism.slots[i])]) {
        const ExactJoint& joint = joints_[static_cast<std::size_t>(j)];
        if (!taken[static_cast<std::size_t>(j)]) mechanism.joints.push_back(j);
        taken[static_cast<std::size_t>(j)] = 1;
        for (const int slot : {joint.slot_a, joint.slot_b}) {
          if (slot < 0 || slots_[static_cast<std::size_t>(slot)].mechanism >= 0) continue;
          slots_[static_cast<std::size_t>(slot)].mechanism = index;
          mechanism.slots.push_back(slot);
        }
      }
    }
    std::sort(mechanism.joints.begin(), mechanism.joints.end());
  }
  found_.resize(mechanisms_.size());
}

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
      const int slot = IndexOf(edge->other);
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

/// Bodies in the order of their distance from one at the edge: neighbours are near each other.
void ExactStep::Order(Found* found) {
  const std::size_t n = found->slots.size();
  for (std::size_t i = 0; i < n; ++i) {
    slots_[static_cast<std::size_t>(found->slots[i])].place = static_cast<int>(i);
  }
  std::vector<std::vector<int>> near(n);
  const auto join = [&](int a, int b) {
    near[static_cast<std::size_t>(a)].push_back(b);
    near[static_cast<std::size_t>(b)].push_back(a);
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
    const int a = place(IndexOf(const_cast<b2Fixture*>(contact->GetFixtureA())->GetBody()));
    const int b = place(IndexOf(const_cast<b2Fixture*>(contact->GetFixtureB())->GetBody()));
    if (a >= 0 && b >= 0) join(a, b);
  }
  std::vector<int> order;
  std::size_t start = 0;
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<char> seen(n, 0);
    order.clear();
    const auto visit = [&](std::size_t i) {
      if (seen[i]) return;
      seen[i] = 1;
      order.push_back(static_cast<int>(i));
    };
    visit(start);
    for (std::size_t next = 0, k = 0; k < n; ++k) {
      if (k == order.size()) {  // what only anchored things hold together
        while (seen[next]) ++next;
        visit(next);
      }
      for (const int other : near[static_cast<std::size_t>(order[k])]) {
        visit(static_cast<std::size_t>(other));
      }
    }
    start = static_cast<std::size_t>(order.back());
  }
  std::vector<int> sorted;
  for (const int i : order) sorted.push_back(found->slots[static_cast<std::size_t>(i)]);
  found->slots = sorted;
}

void ExactStep::Build(Found* found, bool relaxed) {
  Order(found);
  if (relaxed) {
    std::stable_sort(found->slots.begin(), found->slots.end(), [this](int a, int b) {
      return slots_[static_cast<std::size_t>(a)].mechanism <
             slots_[static_cast<std::size_t>(b)].mechanism;
    });
  }
  found->island = std::make_unique<ExactIsland>();
  ExactIsland& island = *found->island;
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
    if (Moves(body)) return slots_[static_cast<std::size_t>(IndexOf(body))].place;
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
  island.Shape(relaxed);
  if (relaxed || island.cost() <= kDirectMost) return;
  if (solver_.joints == JointSolving::kAuto) {
    found->island.reset();  // left to the engine
  } else {
    Build(found, true);
  }
}

void ExactStep::Sign(const Found& found, std::vector<const void*>* sign) const {
  sign->clear();
  const auto number = [&](int n) {
    sign->push_back(reinterpret_cast<const void*>(std::intptr_t{n}));
  };
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

void ExactStep::LoadPoses(Found* found) {
  for (ExactBody& q : found->island->bodies) {
    b2Body* body = q.body;
    if (q.slot < 0) {
      ReadPose(body, &q);
    } else {
      const Slot& s = slots_[static_cast<std::size_t>(q.slot)];
      if (Told(s)) {
        q.x = s.x;
        q.y = s.y;
        q.a = s.a;
        q.vx = s.vx;
        q.vy = s.vy;
        q.w = s.w;
      } else {
        ReadPose(body, &q);
      }
    }
    q.c = std::cos(q.a);
    q.s = std::sin(q.a);
  }
}

void ExactStep::Load(Found* found) {
  LoadPoses(found);
  const b2Vec2 gravity = world_->GetGravity();
  for (ExactBody& q : found->island->bodies) {
    if (q.slot < 0) continue;
    b2Body* body = q.body;
    body->*Member(BodyFlags()) |= kBodyAwake;
    const b2Vec2& force = body->*Member(BodyForce());
    const auto scale = static_cast<double>(body->GetGravityScale());
    q.lasting = slots_[static_cast<std::size_t>(q.slot)].lasting;
    q.ax = scale * static_cast<double>(gravity.x) + q.im * static_cast<double>(force.x);
    q.ay = scale * static_cast<double>(gravity.y) + q.im * static_cast<double>(force.y);
    q.turn = static_cast<double>(body->*Member(BodyTorque())) / q.inertia;
    q.slow = static_cast<double>(body->GetLinearDamping());
    q.slow_spin = static_cast<double>(body->GetAngularDamping());
  }
}

void ExactStep::SavePoses(const Found& found) {
  for (const ExactBody& q : found.island->bodies) {
    if (q.slot < 0) continue;
    Slot& s = slots_[static_cast<std::size_t>(q.slot)];
    b2Body* body = q.body;
    s.known = true;
    s.x = q.x;
    s.y = q.y;
    s.a = q.a;
    s.vx = q.vx;
    s.vy = q.vy;
    s.w = q.w;
    s.lasting = q.lasting;
    s.told_x = static_cast<float>(q.x);
    s.told_y = static_cast<float>(q.y);
    s.told_a = static_cast<float>(q.a);
    s.told_vx = static_cast<float>(q.vx);
    s.told_vy = static_cast<float>(q.vy);
    s.told_w = static_cast<float>(q.w);
    b2Sweep& sweep = body->*Member(BodySweep());
    sweep.c.Set(s.told_x, s.told_y);
    sweep.a = s.told_a;
    b2Transform& pose = body->*Member(BodyPose());
    pose.q.Set(sweep.a);
    pose.p = sweep.c - b2Mul(pose.q, sweep.localCenter);
    (body->*Member(BodyVelocity())).Set(s.told_vx, s.told_vy);
    body->*Member(BodySpin()) = s.told_w;
    (body->*Member(SyncFixtures()))();
  }
}

void ExactStep::Save(Found* found, float h) {
  float quiet = b2_maxFloat;
  for (const ExactContact& contact : found->island->contacts) {
    for (const int end : {contact.a, contact.b}) {
      const ExactBody& q = found->island->bodies[static_cast<std::size_t>(end)];
      if (!q.moves() && (q.vx != 0 || q.vy != 0 || q.w != 0)) quiet = 0;
    }
  }
  for (const ExactBody& q : found->island->bodies) {
    if (q.slot < 0) continue;
    b2Sweep& sweep = q.body->*Member(BodySweep());
    sweep.c0 = sweep.c;
    sweep.a0 = sweep.a;
  }
  SavePoses(*found);
  for (const ExactBody& q : found->island->bodies) {
    if (q.slot < 0) continue;
    b2Body* body = q.body;
    const float spin = body->GetAngularVelocity();
    const bool slow = spin * spin <= b2_angularSleepTolerance * b2_angularSleepTolerance &&
                      body->GetLinearVelocity().LengthSquared() <=
                          b2_linearSleepTolerance * b2_linearSleepTolerance;
    float& slept = body->*Member(BodySleepTime());
    slept = slow && (body->*Member(BodyFlags()) & kBodyAutoSleep) != 0 ? slept + h : 0;
    quiet = std::min(quiet, slept);
  }
  found->island->Store();
  if (world_->GetAllowSleeping() && quiet >= b2_timeToSleep) {
    for (const ExactBody& q : found->island->bodies) {
      if (q.slot >= 0) q.body->SetAwake(false);
    }
  }
}

void ExactStep::Report(const Found& found) const {
  b2ContactListener* listener = world_->GetContactManager().m_contactListener;
  if (listener == nullptr) return;
  for (const ExactContact& contact : found.island->contacts) {
    const b2Manifold& manifold = *contact.made->GetManifold();
    b2ContactImpulse impulse;
    impulse.count = contact.count;
    for (int i = 0; i < contact.count; ++i) {
      impulse.normalImpulses[i] = manifold.points[i].normalImpulse;
      impulse.tangentImpulses[i] = manifold.points[i].tangentImpulse;
    }
    listener->PostSolve(contact.made, &impulse);
  }
}

/// The engine's own Solve must not see what has been solved.
void ExactStep::Hide(const Found& found) {
  for (const ExactBody& q : found.island->bodies) {
    if (q.slot >= 0) q.body->*Member(BodyFlags()) &= static_cast<uint16>(~kBodyEnabled);
  }
  for (const ExactContact& contact : found.island->contacts) {
    contact.made->*Member(ContactFlags()) &= ~kContactEnabled;
  }
}

void ExactStep::Show(const Found& found) {
  for (const ExactBody& q : found.island->bodies) {
    if (q.slot >= 0) q.body->*Member(BodyFlags()) |= kBodyEnabled;
  }
  for (const ExactContact& contact : found.island->contacts) {
    contact.made->*Member(ContactFlags()) |= kContactEnabled;
  }
}

/// Makes the island for what was gathered, if the last one is not for the same.
void ExactStep::Prepare(float h, Found* found) {
  for (const int m : found->mechanisms) {
    for (const int j : mechanisms_[static_cast<std::size_t>(m)].joints) {
      LookAt(static_cast<double>(h), &joints_[static_cast<std::size_t>(j)]);
    }
  }
  Sign(*found, &sign_);
  if (sign_ == found->sign) return;
  Build(found, false);
  found->sign = sign_;
}

bool ExactStep::Told(const Slot& s) {
  const b2Sweep& sweep = s.body->*Member(BodySweep());
  const b2Vec2& v = s.body->GetLinearVelocity();
  return s.known && sweep.c.x == s.told_x && sweep.c.y == s.told_y && sweep.a == s.told_a &&
         v.x == s.told_vx && v.y == s.told_vy && s.body->GetAngularVelocity() == s.told_w;
}

/// Listens while the engine does continuous collision. Its blow on a mechanism's body by something
/// that does not give way is not heard of: the whole mechanism has it in the next step. Between
/// moving bodies (bullets) the blow counts, and `struck` remembers whom it met.
class ExactStep::Quiet : public b2ContactListener {
 public:
  Quiet(b2ContactListener* listener, std::vector<Slot>* slots)
      : listener_(listener), slots_(slots) {}
  void BeginContact(b2Contact* contact) override { listener_->BeginContact(contact); }
  void EndContact(b2Contact* contact) override { listener_->EndContact(contact); }
  void PreSolve(b2Contact* contact, const b2Manifold* old) override {
    listener_->PreSolve(contact, old);
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    b2Body* const a = contact->GetFixtureA()->GetBody();
    b2Body* const b = contact->GetFixtureB()->GetBody();
    const bool both = Moves(a) && Moves(b);
    bool ours = false;
    for (b2Body* body : {a, b}) {
      if (!Moves(body)) continue;
      Slot& slot = (*slots_)[static_cast<std::size_t>(IndexOf(body))];
      slot.struck = slot.struck || both;
      ours = ours || slot.island >= 0;
    }
    if (both || !ours) listener_->PostSolve(contact, impulse);
  }

 private:
  b2ContactListener* const listener_;
  std::vector<Slot>* const slots_;
};

/// As the engine's, but what it took back to where it hit keeps its velocity and its joints.
void ExactStep::Continuous(const b2TimeStep& step, const Pace& pace) {
  b2ContactListener* const listener = world_->GetContactManager().m_contactListener;
  Quiet quiet(listener, &slots_);
  for (Slot& slot : slots_) slot.struck = false;
  world_->SetContactListener(&quiet);
  (world_->*Member(EngineSolveToi()))(step);
  world_->SetContactListener(listener);
  RejoinWhatMoved(step.dt, pace);
}

void ExactStep::RejoinWhatMoved(float h, const Pace& pace) {
  std::vector<int> moved;
  for (const int m : solved_) {
    const Found& found = found_[static_cast<std::size_t>(m)];
    for (const int slot : found.slots) {
      const Slot& s = slots_[static_cast<std::size_t>(slot)];
      if (!s.body->IsAwake() || Told(s)) continue;
      moved.insert(moved.end(), found.mechanisms.begin(), found.mechanisms.end());
      break;
    }
  }
  if (moved.empty()) return;
  for (Slot& slot : slots_) slot.island = -1;
  for (const int m : moved) {
    if (slots_[static_cast<std::size_t>(mechanisms_[static_cast<std::size_t>(m)].slots[0])]
            .island >= 0) {
      continue;
    }
    Found& found = found_[static_cast<std::size_t>(m)];
    if (!Gather(m, &found)) continue;
    Prepare(h, &found);
    if (!found.island) continue;
    LoadPoses(&found);
    bool struck = false;
    for (ExactBody& q : found.island->bodies) {
      if (q.slot < 0) continue;
      const Slot& s = slots_[static_cast<std::size_t>(q.slot)];
      struck = struck || s.struck;
      if (s.struck || !s.known) continue;
      q.vx = s.vx;
      q.vy = s.vy;
      q.w = s.w;
    }
    found.island->Rejoin(pace, struck);
    SavePoses(found);
  }
}

void ExactStep::Step(float h, int velocity_iterations, int position_iterations) {
  auto& contacts = const_cast<b2ContactManager&>(world_->GetContactManager());
  bool& fresh = world_->*Member(NewContacts());
  if (fresh) contacts.FindNewContacts();
  fresh = false;
  bool& locked = world_->*Member(Locked());
  locked = true;
  float& last_inverse = world_->*Member(LastInverseStep());
  b2TimeStep step;
  step.dt = h;
  step.inv_dt = 1 / h;
  step.dtRatio = last_inverse * h;
  step.velocityIterations = velocity_iterations;
  step.positionIterations = position_iterations;
  step.warmStarting = world_->GetWarmStarting();
  contacts.Collide();

  for (Slot& slot : slots_) slot.island = -1;
  const Pace pace{static_cast<double>(h) / solver_.joint_substeps, solver_.joint_substeps};
  std::size_t moving = 0;
  solved_.clear();
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    if (slots_[static_cast<std::size_t>(mechanisms_[m].slots[0])].island >= 0) continue;
    Found& found = found_[m];
    if (!Gather(static_cast<int>(m), &found)) continue;
    Prepare(h, &found);
    if (!found.island) continue;
    Load(&found);
    found.island->Step(pace, step.warmStarting);
    Save(&found, h);
    Report(found);
    Hide(found);
    moving += found.slots.size();
    solved_.push_back(static_cast<int>(m));
  }
  if (moving < slots_.size() || paths_) {
    (world_->*Member(EngineSolve()))(step);
  } else {
    contacts.FindNewContacts();
  }
  for (const int m : solved_) Show(found_[static_cast<std::size_t>(m)]);
  if (world_->GetContinuousPhysics()) Continuous(step, pace);
  last_inverse = step.inv_dt;
  if (world_->GetAutoClearForces()) world_->ClearForces();
  locked = false;
}

}  // namespace seam
