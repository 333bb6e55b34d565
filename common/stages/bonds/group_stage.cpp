#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "common/scene/grouping.h"
#include "common/stages/make_stages.h"
#include "common/stages/stage_memory.h"

namespace seam {
namespace {

/// A joint that is none of rigid bonds holds the assembly.
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

class GroupStage : public Stage {
 public:
  explicit GroupStage(const StageWorld& world) : w_(world) {}

  void Rebuilt(b2World* /*world*/) override {}
  void BeforeTick() override;
  void AfterTick() override;
  void ProposeEdits(std::vector<Edit>* edits) override;
  void Edited(const Edit& edit) override;
  void Save(std::vector<float>* memory) const override;
  std::size_t Load(const float* memory) override;

 private:
  void Look();
  bool Moves(int body) const;
  bool MayJoin(int body) const;
  void Undo(int body);
  BondEdit BondOf(int body, int other) const;

  const StageWorld w_;
  bool stale_ = true;
  std::vector<bool> single_;               // by body: no joint holds it
  std::vector<std::vector<int>> groups_;   // by body: joints that a touch undoes
  std::map<PartId, int> quiet_;            // ticks at rest, by assembly, up to the limit
  std::vector<b2Vec2> before_;             // m/s, by body, before the tick
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

bool GroupStage::Moves(int body) const {
  const b2Body* b = w_.built.moving[static_cast<std::size_t>(body)].body;
  return b->IsAwake() && (b->GetLinearVelocity().Length() > kRestSpeed ||
                          std::fabs(b->GetAngularVelocity()) > kRestSpin);
}

bool GroupStage::MayJoin(int body) const {
  const MovingBody& m = w_.built.moving[static_cast<std::size_t>(body)];
  const auto quiet = quiet_.find(m.id);
  const float limit = w_.scene.grouping->after * static_cast<float>(w_.scene.solver.tick_hz);
  return single_[static_cast<std::size_t>(body)] && m.body->GetType() == b2_dynamicBody &&
         quiet != quiet_.end() && static_cast<float>(quiet->second) >= limit;
}

void GroupStage::Undo(int body) {
  const std::vector<int>& joints = groups_[static_cast<std::size_t>(body)];
  undone_.insert(joints.begin(), joints.end());
}

void GroupStage::AfterTick() {
  const int bodies = static_cast<int>(w_.built.moving.size());
  const auto most =
      static_cast<int>(w_.scene.grouping->after * static_cast<float>(w_.scene.solver.tick_hz)) + 1;
  std::vector<bool> moves;
  for (int body = 0; body < bodies; ++body) {
    moves.push_back(Moves(body));
    int& quiet = quiet_[w_.built.moving[static_cast<std::size_t>(body)].id];
    quiet = moves.back() ? 0 : std::min(quiet + 1, most);
  }
  for (int body = 0; body < bodies; ++body) {
    const MovingBody& m = w_.built.moving[static_cast<std::size_t>(body)];
    const b2Vec2 change = m.body->GetLinearVelocity() - before_[static_cast<std::size_t>(body)];
    if (moves[static_cast<std::size_t>(body)] || change.Length() > w_.scene.grouping->impact) {
      Undo(body);
    }
    const bool ripe = MayJoin(body);
    if (!ripe && !moves[static_cast<std::size_t>(body)]) continue;
    for (const b2ContactEdge* edge = m.body->GetContactList(); edge; edge = edge->next) {
      const int other = IndexOf(edge->other);
      const bool sensor =
          edge->contact->GetFixtureA()->IsSensor() || edge->contact->GetFixtureB()->IsSensor();
      if (other < 0 || sensor) continue;
      // The engine's boxes meet before the shapes do.
      if (moves[static_cast<std::size_t>(body)]) Undo(other);
      const bool touch = edge->contact->IsTouching();
      if (touch && ripe && body < other && MayJoin(other)) resting_.insert({body, other});
    }
  }
}

/// As they lie.
BondEdit GroupStage::BondOf(int body, int other) const {
  const MovingBody& a = w_.built.moving[static_cast<std::size_t>(body)];
  const MovingBody& b = w_.built.moving[static_cast<std::size_t>(other)];
  const b2Vec2 place = a.body->GetLocalPoint(b.body->GetPosition());
  BondEdit edit;
  edit.cause = BondCause::kGroup;
  edit.a = a.id;
  edit.b = b.id;
  edit.position = FromB2(place);
  edit.angle = std::remainder(b.body->GetAngle() - a.body->GetAngle(), 6.2831853f);
  return edit;
}

void GroupStage::ProposeEdits(std::vector<Edit>* edits) {
  for (const int joint : undone_) {
    if (w_.scene.joints[static_cast<std::size_t>(joint)].gone) continue;
    edits->emplace_back(BreakEdit{joint});
  }
  if (stale_) return;  // the bodies are others already
  // Of all that touch, only so many that each is held once.
  std::vector<int> group(w_.built.moving.size());
  std::iota(group.begin(), group.end(), 0);
  const auto name = [&group](int i) {
    while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
    return i;
  };
  for (const auto& [body, other] : resting_) {
    const int one = name(body), two = name(other);
    if (one == two) continue;
    group[static_cast<std::size_t>(std::max(one, two))] = std::min(one, two);
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
  for (const PartId part : {joint.a, joint.b}) {
    const int assembly = w_.composition.assembly_of_part[static_cast<std::size_t>(part)];
    if (assembly < 0) continue;
    quiet_[w_.composition.assemblies[static_cast<std::size_t>(assembly)].id] = 0;
  }
}

void GroupStage::Save(std::vector<float>* memory) const { SaveTicks(quiet_, memory); }

std::size_t GroupStage::Load(const float* memory) { return LoadTicks(memory, &quiet_); }

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
