#include "common/physics/contacts/soft_step.h"

#include <algorithm>

#include "common/physics/engine_members.h"

namespace seam {
namespace {

/// Islands of so many points or fewer are solved with more rounds.
constexpr int kPointsOfSmall = 16;

}  // namespace

SoftStep::SoftStep(const Solver& solver, b2World* world, const BuiltScene& built,
                   const std::vector<int>& made)
    : substeps_(solver.contact_substeps),
      sweeps_(1 + solver.velocity_iterations / solver.contact_substeps),
      world_(world),
      place_(built.moving.size(), -1) {
  for (const int body : made) {
    place_[static_cast<std::size_t>(body)] = static_cast<int>(all_.size());
    all_.push_back(built.moving[static_cast<std::size_t>(body)].body);
  }
  jointed_.assign(all_.size(), 0);
  for (std::size_t i = 0; i < all_.size(); ++i) {
    for (b2JointEdge* edge = all_[i]->GetJointList(); edge != nullptr; edge = edge->next) {
      jointed_[i] = 1;
      const int other = Moves(edge->other) ? PlaceOf(edge->other) : -1;
      if (other < static_cast<int>(i)) continue;  // found from there, or fixed
      joints_.push_back(static_cast<int>(i));
      joints_.push_back(other);
    }
  }
  sets_ = DisjointSets(all_.size());
  islands_.resize(all_.size());
  index_.resize(all_.size());
  FindReaches();
}

int SoftStep::PlaceOf(b2Body* body) const {
  return place_[static_cast<std::size_t>(IndexOf(body))];
}

void SoftStep::FindIslands() {
  sets_.Separate();
  std::fill(islands_.begin(), islands_.end(), Island{});
  for (std::size_t i = 0; i < joints_.size(); i += 2) sets_.Unite(joints_[i], joints_[i + 1]);
  pairs_.clear();
  for (b2Contact* c = world_->GetContactList(); c != nullptr; c = c->GetNext()) {
    if (!Pushes(c)) continue;
    Pair pair{c, -1, -1};
    b2Body* const a = c->GetFixtureA()->GetBody();
    b2Body* const b = c->GetFixtureB()->GetBody();
    if (Moves(a)) pair.a = PlaceOf(a);
    if (Moves(b)) pair.b = PlaceOf(b);
    if (pair.a >= 0 && pair.b >= 0) sets_.Unite(pair.a, pair.b);
    pairs_.push_back(pair);
  }
  for (std::size_t i = 0; i < all_.size(); ++i) {
    Island& island = IslandOf(static_cast<int>(i));
    island.awake = island.awake || all_[i]->IsAwake();
    island.jointed = island.jointed || jointed_[i] != 0;
    island.quiet = b2_maxFloat;
  }
  for (const Pair& pair : pairs_) {
    IslandOf(std::max(pair.a, pair.b)).points += pair.made->GetManifold()->pointCount;
    if (pair.a >= 0 && pair.b >= 0) continue;
    b2Fixture* const fixed = pair.a >= 0 ? pair.made->GetFixtureB() : pair.made->GetFixtureA();
    const b2Body* const body = fixed->GetBody();
    if (body->GetType() != b2_kinematicBody) continue;
    Island& island = IslandOf(std::max(pair.a, pair.b));
    island.awake = island.awake || body->IsAwake();
    island.driven = island.driven || body->GetLinearVelocity().LengthSquared() > 0 ||
                    body->GetAngularVelocity() != 0;
  }
}

/// Lists the bodies of our islands, and wakes them. Returns true if an awake island is left.
bool SoftStep::FindOurs() {
  bool left = false;
  ours_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    b2Body* const body = all_[i];
    index_[i] = -1;
    if (!body->IsEnabled() || !Moves(body)) continue;
    const Island& island = IslandOf(static_cast<int>(i));
    if (!island.awake) continue;
    left = left || island.jointed;
    if (island.jointed) continue;
    body->*Member(BodyFlags()) |= kBodyAwake;  // without starting its rest anew
    index_[i] = static_cast<int>(ours_.size());
    ours_.push_back(static_cast<int>(i));
  }
  return left;
}

void SoftStep::Load() {
  const b2Vec2 gravity = world_->GetGravity();
  soft_.bodies.clear();
  for (const int i : ours_) {
    b2Body* const body = all_[static_cast<std::size_t>(i)];
    const b2Vec2 v = body->GetLinearVelocity();
    const b2Vec2& force = body->*Member(BodyForce());
    SoftBody q;
    q.vx = v.x;
    q.vy = v.y;
    q.w = body->GetAngularVelocity();
    q.im = body->*Member(BodyInverseMass());
    q.ii = body->*Member(BodyInverseInertia());
    q.ax = body->GetGravityScale() * gravity.x + q.im * force.x;
    q.ay = body->GetGravityScale() * gravity.y + q.im * force.y;
    q.turn = q.ii * (body->*Member(BodyTorque()));
    q.slow = body->GetLinearDamping();
    q.slow_spin = body->GetAngularDamping();
    soft_.bodies.push_back(q);
  }
  soft_.moving = soft_.bodies.size();
  soft_.bodies.push_back({});  // anything that rests
}

/// Returns the index of a body that does not move by impulses. All that rest share one.
int SoftStep::Fixed(b2Body* body) {
  if (body->GetType() == b2_staticBody) return static_cast<int>(soft_.moving);
  for (std::size_t i = fixed_.size(); i-- > 0;) {
    if (fixed_[i] == body) return static_cast<int>(soft_.moving + 1 + i);
  }
  // Its velocity is the mean of the step, about which its own changes evenly.
  const b2Vec2 gain = body->*Member(BodyForce());
  const b2Vec2 begin = body->GetLinearVelocity() - step_s_ / 2 * gain;
  SoftBody q;
  q.vx = begin.x;
  q.vy = begin.y;
  q.w = body->GetAngularVelocity();
  q.ax = gain.x;
  q.ay = gain.y;
  fixed_.push_back(body);
  soft_.bodies.push_back(q);
  return static_cast<int>(soft_.bodies.size()) - 1;
}

void SoftStep::LoadContacts() {
  soft_.contacts.clear();
  fixed_.clear();
  for (const Pair& pair : pairs_) {
    const int ours = index_[static_cast<std::size_t>(std::max(pair.a, pair.b))];
    if (ours < 0) continue;
    SoftContact contact;
    contact.made = pair.made;
    contact.a = pair.a < 0 ? Fixed(pair.made->GetFixtureA()->GetBody())
                           : index_[static_cast<std::size_t>(pair.a)];
    contact.b = pair.b < 0 ? Fixed(pair.made->GetFixtureB()->GetBody())
                           : index_[static_cast<std::size_t>(pair.b)];
    contact.small = IslandOf(std::max(pair.a, pair.b)).points <= kPointsOfSmall;
    soft_.contacts.push_back(contact);
  }
}

void SoftStep::Save(float h) {
  for (std::size_t k = 0; k < ours_.size(); ++k) {
    const auto i = static_cast<std::size_t>(ours_[k]);
    b2Body* const body = all_[i];
    const SoftBody& q = soft_.bodies[k];
    b2Sweep& sweep = body->*Member(BodySweep());
    sweep.c0 = sweep.c;
    sweep.a0 = sweep.a;
    sweep.c += b2Vec2(q.dx, q.dy);
    sweep.a += q.da;
    b2Transform& pose = body->*Member(BodyPose());
    pose.q.Set(sweep.a);
    pose.p = sweep.c - b2Mul(pose.q, sweep.localCenter);
    (body->*Member(BodyVelocity())).Set(q.vx, q.vy);
    body->*Member(BodySpin()) = q.w;
    (body->*Member(SyncFixtures()))();
    const bool slow =
        q.w * q.w <= b2_angularSleepTolerance * b2_angularSleepTolerance &&
        q.vx * q.vx + q.vy * q.vy <= b2_linearSleepTolerance * b2_linearSleepTolerance;
    float& slept = body->*Member(BodySleepTime());
    slept = slow && (body->*Member(BodyFlags()) & kBodyAutoSleep) != 0 ? slept + h : 0;
    Island& island = IslandOf(ours_[k]);
    island.quiet = island.driven ? 0 : std::min(island.quiet, slept);
  }
  if (!world_->GetAllowSleeping()) return;
  for (const int i : ours_) {
    const Island& island = IslandOf(i);
    if (island.quiet >= b2_timeToSleep) all_[static_cast<std::size_t>(i)]->SetAwake(false);
  }
}

void SoftStep::Report() {
  touched_.assign(soft_.bodies.size(), 0);
  untaken_.assign(soft_.bodies.size(), 0);
  b2ContactListener* const listener = world_->GetContactManager().m_contactListener;
  for (const SoftContact& contact : soft_.contacts) {
    b2ContactImpulse impulse;
    const float sum = soft_.Take(contact, &impulse);
    if (sum > 0) {
      touched_[static_cast<std::size_t>(contact.a)] = 1;
      touched_[static_cast<std::size_t>(contact.b)] = 1;
    }
    if (listener != nullptr) listener->PostSolve(contact.made, &impulse);
  }
}

bool SoftStep::Solve(float h) {
  step_s_ = h;
  FindIslands();
  const bool left = FindOurs();
  Load();
  LoadContacts();
  soft_.Step(h / static_cast<float>(substeps_), substeps_, sweeps_, world_->GetWarmStarting());
  Save(h);
  Report();
  for (const int i : ours_) {
    all_[static_cast<std::size_t>(i)]->*Member(BodyFlags()) &= static_cast<uint16>(~kBodyEnabled);
  }
  for (const SoftContact& contact : soft_.contacts) {
    contact.made->*Member(ContactFlags()) &= ~kContactEnabled;
  }
  return left;
}

void SoftStep::AtImpact(b2Body* body) {
  const int ours = Moves(body) ? index_[static_cast<std::size_t>(PlaceOf(body))] : -1;
  if (ours < 0 || touched_[static_cast<std::size_t>(ours)]) return;
  const SoftBody& q = soft_.bodies[static_cast<std::size_t>(ours)];
  float& untaken = untaken_[static_cast<std::size_t>(ours)];
  const float rest = (1 - (body->*Member(BodySweep())).alpha0) * step_s_;
  body->*Member(BodyVelocity()) -= (rest - untaken) * b2Vec2(q.ax, q.ay);
  untaken = rest;
}

void SoftStep::Fall() {
  for (std::size_t k = 0; k < ours_.size(); ++k) {
    if (untaken_[k] <= 0) continue;
    b2Body* const body = all_[static_cast<std::size_t>(ours_[k])];
    const SoftBody& q = soft_.bodies[k];
    body->*Member(BodyVelocity()) += untaken_[k] * b2Vec2(q.ax, q.ay);
    untaken_[k] = 0;
  }
}

void SoftStep::Show() {
  for (const int i : ours_) all_[static_cast<std::size_t>(i)]->*Member(BodyFlags()) |= kBodyEnabled;
  for (const SoftContact& contact : soft_.contacts) {
    contact.made->*Member(ContactFlags()) |= kContactEnabled;
  }
}

}  // namespace seam
