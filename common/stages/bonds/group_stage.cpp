#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/disjoint_sets.h"
#include "common/base/geometry.h"
#include "common/physics/world_shapes.h"
#include "common/scene/grouping.h"
#include "common/stages/bonds/relative_rest.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

/// Returns the assemblies held by a joint to another assembly.
std::set<int> HeldAssemblies(const Scene& scene, const Composition& composition) {
  std::set<int> held;
  for (const Joint& joint : scene.joints) {
    const int a = joint.gone ? -1 : composition.assembly_of_part[static_cast<std::size_t>(joint.a)];
    const int b = joint.gone ? -1 : composition.assembly_of_part[static_cast<std::size_t>(joint.b)];
    if (a == b) continue;
    held.insert({a, b});
  }
  return held;
}

/// A group is undone only by a relative motion this many times that at which one forms: otherwise
/// groups would come and go.
constexpr float kUndoneFactor = 2;
/// Two bodies will meet soon if their gap is below kMeetGap, m, plus kMeetTicks at their relative
/// speed: no less than the engine's boxes are enlarged by and look ahead.
constexpr float kMeetGap = 2 * b2_aabbExtension, kMeetTicks = 4;
/// Ticks between searches for resting pairs. Groups are watched in every tick.
constexpr int kLookTicks = 4;

class GroupStage : public Stage {
 public:
  explicit GroupStage(const StageWorld& world) : w_(world) {}

  void Rebuilt(b2World* world) override { world_ = world; }
  void Emptied() override { world_ = nullptr; }
  void BeforeTick() override;
  void AfterTick() override;
  void ProposeEdits(std::vector<Edit>* edits) override;
  void Edited(const Edit& edit) override;
  void Save(std::vector<float>* memory) const override { pairs_.Save(memory); }
  std::size_t Load(const float* memory) override { return pairs_.Load(memory); }

 private:
  enum class State {
    kAtRest,
    kPressed,    // overlapped more than at rest: does not join
    kDisturbed,  // relative motion nearby, or shaken
  };

  void Look();
  bool IsShaken(int body) const;
  bool MayJoin(int body) const;
  RelativeMotion Disturb(b2Contact* contact);
  void Note(const b2Contact& contact, State state);
  void FindRestingPairs();
  void WatchGroups();
  BondEdit BondOf(int body, int other) const;

  const StageWorld w_;
  b2World* world_ = nullptr;
  bool stale_ = true;
  std::vector<bool> single_;              // by body: no joint holds it
  std::vector<std::vector<int>> groups_;  // by body: joints that a disturbance undoes
  RestPairs pairs_;
  std::vector<b2Vec2> before_;             // m/s, by body, before the tick
  std::vector<State> states_;              // by body, in this tick
  std::set<std::pair<int, int>> resting_;  // bodies to be grouped
  std::set<int> undone_;                   // joints
};

void GroupStage::Look() {
  if (!stale_) return;
  stale_ = false;
  const std::size_t bodies = w_.built.moving.size();
  single_.assign(bodies, true);
  groups_.assign(bodies, {});
  const auto body_of = [&](int assembly) {
    return assembly < 0 ? -1 : IndexOf(w_.built.bodies[static_cast<std::size_t>(assembly)]);
  };
  for (const int held : HeldAssemblies(w_.scene, w_.composition)) {
    const int body = body_of(held);
    if (body >= 0) single_[static_cast<std::size_t>(body)] = false;
  }
  for (std::size_t j = 0; j < w_.scene.joints.size(); ++j) {
    const Joint& joint = w_.scene.joints[j];
    if (joint.gone || !joint.grouped) continue;
    const int body = body_of(w_.composition.assembly_of_part[static_cast<std::size_t>(joint.a)]);
    if (body >= 0) groups_[static_cast<std::size_t>(body)].push_back(static_cast<int>(j));
  }
}

void GroupStage::BeforeTick() {
  Look();
  resting_.clear();
  undone_.clear();
  before_.clear();
  for (const MovingBody& m : w_.built.moving) before_.push_back(m.body->GetLinearVelocity());
}

/// Returns true if the forces on the whole group are above the limits.
bool GroupStage::IsShaken(int body) const {
  const b2Body* b = w_.built.moving[static_cast<std::size_t>(body)].body;
  if (!b->IsAwake() || IsAside(*b)) return false;
  const Grouping& limits = *w_.scene.grouping;
  const b2Vec2 change = b->GetLinearVelocity() - before_[static_cast<std::size_t>(body)];
  const float a = change.Length() * static_cast<float>(w_.scene.solver.tick_hz);
  return a > limits.acceleration || change.Length() > limits.impact ||
         std::fabs(b->GetAngularVelocity()) > limits.spin;
}

bool GroupStage::MayJoin(int body) const {
  return single_[static_cast<std::size_t>(body)] &&
         w_.built.moving[static_cast<std::size_t>(body)].body->GetType() == b2_dynamicBody;
}

/// Marks both as disturbed if they move against each other and, at this speed, will meet soon. The
/// engine's boxes meet earlier, so an approaching body finds single bodies again.
RelativeMotion GroupStage::Disturb(b2Contact* contact) {
  b2Body* const bodies[] = {contact->GetFixtureA()->GetBody(), contact->GetFixtureB()->GetBody()};
  const auto wakes = [](b2Body* b) { return b->GetType() != b2_staticBody && b->IsAwake(); };
  if (!wakes(bodies[0]) && !wakes(bodies[1])) return {};
  const RelativeMotion motion = MotionAt(w_, contact);
  const bool moved =
      motion.speed > kUndoneFactor * kRestSpeed || motion.spin > kUndoneFactor * kRestSpin;
  const float way = kMeetTicks * motion.speed / static_cast<float>(w_.scene.solver.tick_hz);
  if (moved && GapOf(contact) <= kMeetGap + way) Note(*contact, State::kDisturbed);
  return motion;
}

void GroupStage::Note(const b2Contact& contact, State state) {
  for (const b2Fixture* fixture : {contact.GetFixtureA(), contact.GetFixtureB()}) {
    const int index = IndexOf(const_cast<b2Fixture*>(fixture)->GetBody());
    if (index < 0) continue;
    State& now = states_[static_cast<std::size_t>(index)];
    now = std::max(now, state);
  }
}

/// Counts the time at rest, and finds the pairs to be grouped.
void GroupStage::FindRestingPairs() {
  for (std::size_t b = 0; b < states_.size(); ++b) {
    if (IsShaken(static_cast<int>(b))) states_[b] = State::kDisturbed;
  }
  std::vector<NearPair> near;
  for (b2Contact* c = world_->GetContactList(); c != nullptr; c = c->GetNext()) {
    b2Fixture* const one = c->GetFixtureA();
    b2Fixture* const other = c->GetFixtureB();
    if (one->IsSensor() || other->IsSensor()) continue;
    const RelativeMotion motion = Disturb(c);
    if (IsInterpenetrating(c)) Note(*c, State::kPressed);
    const int a = IndexOf(one->GetBody()), b = IndexOf(other->GetBody());
    if (a < 0 || b < 0 || !MayJoin(a) || !MayJoin(b)) continue;
    const bool still = motion.speed <= kRestSpeed && motion.spin <= kRestSpin;
    const auto p = static_cast<PartId>(PartOf(one)), q = static_cast<PartId>(PartOf(other));
    near.push_back(p < q ? NearPair{p, q, a, b, still, c->IsTouching(), 0}
                         : NearPair{q, p, b, a, still, c->IsTouching(), 0});
  }
  const auto rests = [this](int body) {
    return states_[static_cast<std::size_t>(body)] == State::kAtRest;
  };
  for (NearPair& pair : near) {
    pair.still = pair.still && rests(pair.body_a) && rests(pair.body_b);
  }
  const float ticks = w_.scene.grouping->after * static_cast<float>(w_.scene.solver.tick_hz);
  const int limit = 1 + static_cast<int>(std::ceil(ticks / kLookTicks));
  pairs_.Count(std::move(near), limit);
  for (const NearPair& pair : pairs_.pairs()) {
    if (pair.looks < limit || !pair.touching) continue;
    resting_.insert(std::minmax(pair.body_a, pair.body_b));
  }
}

/// Checks the contacts of groups, each contact once.
void GroupStage::WatchGroups() {
  for (std::size_t b = 0; b < states_.size(); ++b) {
    if (groups_[b].empty()) continue;
    if (IsShaken(static_cast<int>(b))) states_[b] = State::kDisturbed;
    b2Body* const body = w_.built.moving[b].body;
    for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
      const int other = IndexOf(edge->other);
      const bool seen = other >= 0 && other < static_cast<int>(b) &&  // from there
                        !groups_[static_cast<std::size_t>(other)].empty();
      const b2Contact& contact = *edge->contact;
      if (seen || contact.GetFixtureA()->IsSensor() || contact.GetFixtureB()->IsSensor()) continue;
      Disturb(edge->contact);
    }
  }
}

void GroupStage::AfterTick() {
  states_.assign(w_.built.moving.size(), State::kAtRest);
  if (w_.tick % kLookTicks == 0) {
    FindRestingPairs();
  } else {
    WatchGroups();
  }
  for (std::size_t b = 0; b < states_.size(); ++b) {
    if (states_[b] != State::kDisturbed) continue;
    undone_.insert(groups_[b].begin(), groups_[b].end());
  }
}

/// Returns a bond at the current poses.
BondEdit GroupStage::BondOf(int body, int other) const {
  const MovingBody& a = w_.built.moving[static_cast<std::size_t>(body)];
  const MovingBody& b = w_.built.moving[static_cast<std::size_t>(other)];
  const b2Vec2 place = a.body->GetLocalPoint(b.body->GetPosition());
  BondEdit edit;
  edit.cause = BondCause::kGroup;
  edit.a = a.id;
  edit.b = b.id;
  edit.position = FromB2(place);
  edit.angle = std::remainder(b.body->GetAngle() - a.body->GetAngle(), 2 * kPiFloat);
  return edit;
}

void GroupStage::ProposeEdits(std::vector<Edit>* edits) {
  for (const int joint : undone_) {
    if (w_.scene.joints[static_cast<std::size_t>(joint)].gone) continue;
    edits->emplace_back(BreakEdit{joint});
  }
  if (stale_) return;  // the bodies have already changed
  // Of all touching pairs, only enough bonds to hold each body once.
  DisjointSets groups(w_.built.moving.size());
  for (const auto& [body, other] : resting_) {
    if (groups.Same(body, other)) continue;
    groups.Unite(body, other);
    edits->emplace_back(BondOf(body, other));
  }
}

void GroupStage::Edited(const Edit& edit) {
  stale_ = true;
  const BreakEdit* broken = edit.As<BreakEdit>();
  if (broken == nullptr || broken->joint < 0) return;
  if (broken->joint >= static_cast<int>(w_.scene.joints.size())) return;
  const Joint& joint = w_.scene.joints[static_cast<std::size_t>(broken->joint)];
  if (!joint.grouped) return;
  pairs_.Forget(joint.a);
  pairs_.Forget(joint.b);
}

}  // namespace

bool MayGroup(const Scene& scene, const Composition& composition, const BondEdit& bond) {
  if (bond.cause != BondCause::kGroup) return false;
  if (!(scene.grouping->after > 0) || bond.strength != 0) return false;
  const std::set<int> held = HeldAssemblies(scene, composition);
  for (const PartId part : {bond.a, bond.b}) {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(part)];
    if (composition.assemblies[static_cast<std::size_t>(index)].anchored) return false;
    if (held.count(index) != 0) return false;
  }
  return true;
}

std::unique_ptr<Stage> MakeGroupStage(const StageWorld& world) {
  return std::make_unique<GroupStage>(world);
}

}  // namespace seam
