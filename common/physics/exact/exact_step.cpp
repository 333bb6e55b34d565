#include "common/physics/exact/exact_step.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/base/trig.h"
#include "common/physics/contacts/engine_parts.h"
#include "common/physics/engine_members.h"
#include "common/scene/character.h"

namespace seam {
namespace {

/// Steps for which cosine and sine are turned with the angle before they are computed anew: each
/// turn adds a rounding error.
constexpr int kTurnsMost = 1000;
/// An island that was too expensive is left to the engine, or relaxed, for so many steps.
constexpr int kFallbackSteps = 30;

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

bool SamePose(const ExactBody& p, const ExactBody& q) {
  return p.x == q.x && p.y == q.y && p.a == q.a && p.c == q.c && p.s == q.s;
}

}  // namespace

ExactStep::ExactStep(const Scene& scene, b2World* world, const BuiltScene& built,
                     const BuildMemory& memory, bool has_elastic)
    : solver_(scene.solver), world_(world), slot_of_(built.moving.size(), -1) {
  slots_.reserve(memory.made.size());
  for (const int body : memory.made) {
    slot_of_[static_cast<std::size_t>(body)] = static_cast<int>(slots_.size());
    slots_.emplace_back();
    slots_.back().body = built.moving[static_cast<std::size_t>(body)].body;
  }
  joints_.reserve(memory.joints.size());
  for (const int joint : memory.joints) {
    b2Joint* const made = built.joints[static_cast<std::size_t>(joint)];
    joints_.push_back(ReadJoint(made));
    joints_.back().index = joint;
    joints_.back().slot_a = SlotOf(made->GetBodyA());
    joints_.back().slot_b = SlotOf(made->GetBodyB());
  }
  for (const int assembly : memory.anchored) {
    b2Body* const body = built.bodies[static_cast<std::size_t>(assembly)];
    if (body->GetType() == b2_kinematicBody) paths_.push_back(body);
  }
  FindMechanisms();
  if (solver_.contacts == ContactSolving::kSoft) {
    soft_ = std::make_unique<SoftStep>(solver_, world_, built, memory.made);
  }
  if (has_elastic) {
    std::vector<char> jointed(built.moving.size(), 0);
    for (Slot& slot : slots_) {
      jointed[static_cast<std::size_t>(IndexOf(slot.body))] = slot.mechanism >= 0 ? 1 : 0;
    }
    blows_ = std::make_unique<ElasticImpacts>(built, std::move(jointed));
    if (!blows_->needed()) blows_.reset();
  }
  if (solver_.joints == JointSolving::kAuto) {
    LeaveCharacters(scene);
    LeaveLarge();
  }
  if (soft_) FindLoads();
}

/// Leaves characters to the engine: their gait is tuned on its joints, which are cheaper in a heap.
void ExactStep::LeaveCharacters(const Scene& scene) {
  if (scene.characters.empty()) return;
  std::vector<char> limbs(scene.joints.size(), 0);
  for (const Character& character : scene.characters) {
    for (const int joint : character.joints) limbs[static_cast<std::size_t>(joint)] = 1;
  }
  for (Mechanism& mechanism : mechanisms_) {
    mechanism.exact = std::none_of(mechanism.joints.begin(), mechanism.joints.end(), [&](int j) {
      return limbs[static_cast<std::size_t>(joints_[static_cast<std::size_t>(j)].index)] != 0;
    });
  }
}

ExactStep::~ExactStep() = default;

/// Loads a moving body: as stored by the last solve, or, if changed since, from the engine.
void ExactStep::LoadMoving(ExactBody* q) {
  Slot& s = slots_[static_cast<std::size_t>(q->slot)];
  if (Told(s)) {
    q->x = s.x;
    q->y = s.y;
    q->a = s.a;
    q->vx = s.vx;
    q->vy = s.vy;
    q->w = s.w;
    if (++s.turns < kTurnsMost) {
      q->c = s.c;
      q->s = s.s;
      return;
    }
  } else {
    ReadPose(q->body, q);
  }
  s.turns = 0;
  q->read_a = std::nan("");
  q->c = Cos(q->a);
  q->s = Sin(q->a);
}

void ExactStep::LoadPoses(Found* found) {
  ExactIsland& island = *found->island;
  island.still = true;
  island.displaced = false;
  for (ExactBody& q : island.bodies) {
    const ExactBody before = q;
    if (q.slot >= 0) {
      island.displaced = island.displaced || !Told(slots_[static_cast<std::size_t>(q.slot)]);
      LoadMoving(&q);
      island.still = island.still && SamePose(q, before);
      continue;
    }
    ReadPose(q.body, &q);
    if (q.a != q.read_a) {  // else c and s are up to date
      q.read_a = q.w == 0 ? q.a : std::nan("");
      q.c = Cos(q.a);
      q.s = Sin(q.a);
    }
    island.still = island.still && SamePose(q, before) && q.vx == before.vx && q.vy == before.vy &&
                   q.w == before.w;
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
    s.c = q.c;
    s.s = q.s;
    s.vx = q.vx;
    s.vy = q.vy;
    s.w = q.w;
    s.lasting = q.lasting;
    s.engine_x = static_cast<float>(q.x);
    s.engine_y = static_cast<float>(q.y);
    s.engine_a = static_cast<float>(q.a);
    s.engine_vx = static_cast<float>(q.vx);
    s.engine_vy = static_cast<float>(q.vy);
    s.engine_w = static_cast<float>(q.w);
    b2Sweep& sweep = body->*Member(BodySweep());
    sweep.c.Set(s.engine_x, s.engine_y);
    sweep.a = s.engine_a;
    b2Transform& pose = body->*Member(BodyPose());
    pose.q.Set(sweep.a);
    pose.p = sweep.c - b2Mul(pose.q, sweep.localCenter);
    (body->*Member(BodyVelocity())).Set(s.engine_vx, s.engine_vy);
    body->*Member(BodySpin()) = s.engine_w;
    (body->*Member(SyncFixtures()))();
  }
}

void ExactStep::Save(Found* found, float h) {
  float quiet = found->island->stirred ? 0 : b2_maxFloat;
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

/// Hides the solved bodies and contacts from the engine's own Solve.
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

bool ExactStep::Told(const Slot& s) {
  const b2Sweep& sweep = s.body->*Member(BodySweep());
  const b2Vec2& v = s.body->GetLinearVelocity();
  return s.known && sweep.c.x == s.engine_x && sweep.c.y == s.engine_y && sweep.a == s.engine_a &&
         v.x == s.engine_vx && v.y == s.engine_vy && s.body->GetAngularVelocity() == s.engine_w;
}

/// False if the island was too expensive; then nothing has changed.
bool ExactStep::Solve(const Pace& pace, bool warm, Found* found) {
  Load(found);
  found->island->Step(pace, warm);
  if (!found->island->given_up()) return true;
  found->fallback_steps = kFallbackSteps;
  found->sign.clear();
  return false;
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

  for (Slot& slot : slots_) {
    slot.island = -1;
    slot.solved = false;
  }
  const Pace pace{static_cast<double>(h) / solver_.joint_substeps, solver_.joint_substeps};
  std::size_t moving = 0;
  solved_.clear();
  const bool iterative = solver_.joints == JointSolving::kIterative;
  for (std::size_t m = 0; m < mechanisms_.size() && !iterative; ++m) {
    if (slots_[static_cast<std::size_t>(mechanisms_[m].slots[0])].island >= 0) continue;
    if (!Counts(mechanisms_[m])) continue;
    const bool load = mechanisms_[m].joints.empty();
    Found& found = found_[m];
    bool ours = Gather(static_cast<int>(m), &found) && !(load && IsHeap(found));
    const bool left = ours && found.fallback_steps > 0;
    if (left) --found.fallback_steps;
    const bool easy = Easy(found);
    found.relaxed = left && !easy;
    if (left && easy) ours = false;
    if (ours) Prepare(h, &found);
    if (ours && found.island && !Solve(pace, step.warmStarting, &found)) {
      found.relaxed = !easy;
      if (found.relaxed) Prepare(h, &found);
      ours = found.relaxed && Solve(pace, step.warmStarting, &found);
    }
    if (!ours || !found.island) {
      if (!load) LeaveToEngine(h, found);
      continue;
    }
    Save(&found, h);
    Report(found);
    found.island->BoundWarmStart();
    Hide(found);
    for (const int slot : found.slots) slots_[static_cast<std::size_t>(slot)].solved = true;
    moving += found.slots.size();
    solved_.push_back(static_cast<int>(m));
  }
  if (blows_) blows_->Act(world_, h, soft_ ? 0 : h / 2);
  const bool left = soft_ ? soft_->Solve(h) : moving < slots_.size();
  if (left || (!soft_ && !paths_.empty())) {
    (world_->*Member(EngineSolve()))(step);
  } else if (soft_) {
    MoveKinematics(h);
    FindNewPairs(world_);
  } else {
    contacts.FindNewContacts();
  }
  if (soft_) soft_->Show();
  for (const int m : solved_) Show(found_[static_cast<std::size_t>(m)]);
  if (world_->GetContinuousPhysics()) Continuous(step, pace);
  if (blows_) blows_->Done();
  last_inverse = step.inv_dt;
  if (world_->GetAutoClearForces()) world_->ClearForces();
  locked = false;
}

}  // namespace seam
