/// ExactStep: kinematic bodies, and continuous collision, which ignores joints.

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/physics/contacts/engine_parts.h"
#include "common/physics/engine_members.h"
#include "common/physics/exact/exact_step.h"

namespace seam {

/// Listens during the engine's continuous collision. Does not report its impacts of a mechanism's
/// body with something immovable: the whole mechanism has that impact in the next step. Impacts
/// between moving bodies (bullets) are reported, and their bodies marked as `struck`.
class ExactStep::Quiet : public b2ContactListener {
 public:
  Quiet(b2ContactListener* listener, ExactStep* step) : listener_(listener), step_(*step) {}
  void BeginContact(b2Contact* contact) override { listener_->BeginContact(contact); }
  void EndContact(b2Contact* contact) override { listener_->EndContact(contact); }
  /// Removes the restitution of an impact that is not reported: otherwise the body would bounce
  /// now, be in the air in the next step and never have the mechanism's impact, while all of its
  /// fall is kept.
  void PreSolve(b2Contact* contact, const b2Manifold* old) override {
    listener_->PreSolve(contact, old);
    if (step_.soft_) {
      step_.soft_->AtImpact(contact->GetFixtureA()->GetBody());
      step_.soft_->AtImpact(contact->GetFixtureB()->GetBody());
    }
    const float gives_back = contact->GetRestitution();
    if (gives_back == 0 || Counts(*contact)) return;
    gave_back_.emplace_back(contact, gives_back);
    contact->SetRestitution(0);
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    b2Body* const a = contact->GetFixtureA()->GetBody();
    b2Body* const b = contact->GetFixtureB()->GetBody();
    const bool both = Moves(a) && Moves(b);
    for (b2Body* body : {a, b}) {
      if (both) SlotOf(body).struck = true;
    }
    if (Counts(*contact)) listener_->PostSolve(contact, impulse);
  }
  /// Restores the contacts' restitution.
  void End() const {
    for (const auto& [contact, gives_back] : gave_back_) contact->SetRestitution(gives_back);
  }

 private:
  Slot& SlotOf(b2Body* body) const {
    return step_.slots_[static_cast<std::size_t>(step_.SlotOf(body))];
  }
  /// True if the impact is the engine's: between two moving bodies, or with no body solved here.
  bool Counts(b2Contact& contact) const {
    bool all = true, ours = false;
    for (b2Body* body : {contact.GetFixtureA()->GetBody(), contact.GetFixtureB()->GetBody()}) {
      const bool moves = Moves(body);
      all = all && moves;
      ours = ours || (moves && SlotOf(body).solved);
    }
    return all || !ours;
  }

  b2ContactListener* const listener_;
  ExactStep& step_;
  std::vector<std::pair<b2Contact*, float>> gave_back_;
};

void ExactStep::MoveKinematics(float h) {
  for (b2Body* const body : paths_) MoveKinematic(world_, body, h);
  for (const Slot& slot : slots_) {
    if (slot.body->GetType() == b2_kinematicBody) MoveKinematic(world_, slot.body, h);
  }
}

/// True if a kinematic body is awake.
bool ExactStep::Driven() const {
  const auto awake = [](const b2Body* body) {
    return body->GetType() == b2_kinematicBody && body->IsAwake();
  };
  return std::any_of(paths_.begin(), paths_.end(), awake) ||
         std::any_of(slots_.begin(), slots_.end(), [&](const Slot& s) { return awake(s.body); });
}

/// As the engine's, but bodies moved back to their impact keep their velocity and their joints.
void ExactStep::Continuous(const b2TimeStep& step, const Pace& pace) {
  b2ContactListener* const listener = world_->GetContactManager().m_contactListener;
  Quiet quiet(listener, this);
  for (Slot& slot : slots_) slot.struck = false;
  if (soft_ && !soft_->Narrow(Driven())) return;
  world_->SetContactListener(&quiet);
  (world_->*Member(EngineSolveToi()))(step);
  world_->SetContactListener(listener);
  if (soft_) soft_->Widen();
  quiet.End();
  if (soft_) soft_->Fall();
  RejoinMoved(step.dt, pace);
}

/// Returns kinetic and potential energy, J. `left`: as before continuous collision.
double ExactStep::EnergyOf(const Found& found, bool left) const {
  const b2Vec2& gravity = world_->GetGravity();
  const auto gx = static_cast<double>(gravity.x), gy = static_cast<double>(gravity.y);
  double sum = 0;
  for (const ExactBody& q : found.island->bodies) {
    if (q.slot < 0) continue;
    const Slot& s = slots_[static_cast<std::size_t>(q.slot)];
    const bool then = left && s.solved;
    const double x = then ? s.x : q.x, y = then ? s.y : q.y;
    const double vx = then ? s.vx : q.vx, vy = then ? s.vy : q.vy, w = then ? s.w : q.w;
    const auto scale = static_cast<double>(s.body->GetGravityScale());
    sum += ((vx * vx + vy * vy) / 2 - scale * (gx * x + gy * y)) / q.im + q.inertia * w * w / 2;
  }
  return sum;
}

/// Bodies that are moved back to their impact, and others with them, may be lifted, in a jam at
/// every step. Takes the gained energy from their motion, and moves the bodies back towards `from`
/// as far as their motion has less.
void ExactStep::RemoveLiftEnergy(double before, const std::vector<ExactBody>& from,
                                 Found* found) const {
  const double kinetic = KineticOf(found->island->bodies);
  const double there = EnergyOf(*found, false);
  double excess = there - before;
  if (excess <= 0) return;
  if (excess > kinetic) {
    std::vector<ExactBody>& bodies = found->island->bodies;
    const std::vector<ExactBody> to = bodies;
    GoShare(from, 0, &bodies);
    const double lift = there - EnergyOf(*found, false);
    bodies = to;
    const double most = lift - (excess - kinetic);
    if (lift > 0) GoShare(from, std::max(0.0, most / lift), &bodies);
    excess = kinetic;
  }
  if (kinetic <= 0) return;
  const double share = std::sqrt(std::max(0.0, 1 - excess / kinetic));
  for (ExactBody& q : found->island->bodies) {
    if (!q.moves()) continue;
    q.vx *= share;
    q.vy *= share;
    q.w *= share;
  }
}

/// Wakes sleeping bodies that Rejoin has moved. A body may touch the mechanism only since that was
/// moved back; asleep it would rest elsewhere than agreed between peers.
void ExactStep::WakeMoved(const Found& found) {
  for (const ExactBody& q : found.island->bodies) {
    if (q.slot < 0 || q.body->IsAwake()) continue;
    const b2Sweep& sweep = q.body->*Member(BodySweep());
    const bool lies = static_cast<float>(q.x) == sweep.c.x &&
                      static_cast<float>(q.y) == sweep.c.y && static_cast<float>(q.a) == sweep.a;
    if (!lies) q.body->SetAwake(true);
  }
}

void ExactStep::RejoinMoved(float h, const Pace& pace) {
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
    const double before = EnergyOf(found, true);
    const std::vector<ExactBody> from = found.island->bodies;
    found.island->Rejoin(pace, struck);
    RemoveLiftEnergy(before, from, &found);
    WakeMoved(found);
    SavePoses(found);
  }
}

}  // namespace seam
