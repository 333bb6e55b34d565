#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "common/base/geometry.h"
#include "common/base/trig.h"
#include "common/scene/connectors.h"
#include "common/scene/mass.h"
#include "common/stages/make_stages.h"
#include "common/stages/stage_memory.h"
#include "common/topology/join.h"

namespace seam {
namespace {

/// A free connector on a body.
struct Open {
  FreeConnector what;
  int assembly = 0;    // index into Composition::assemblies
  b2Vec2 local{0, 0};  // m, in the body's frame
  float turn = 0;      // rad, in the body's frame
};

/// Current place of a free connector.
struct Where {
  const Open* open = nullptr;
  b2Vec2 at{0, 0};        // m
  float angle = 0;        // rad
  b2Vec2 velocity{0, 0};  // m/s
};

/// An outlet and an inlet that meet, ordered by distance.
using Meeting = std::tuple<float, PartId, int, PartId, int>;  // distance, outlet, inlet

class JoinStage : public Stage {
 public:
  explicit JoinStage(const StageWorld& world) : w_(world) {}

  void Rebuilt(b2World* /*world*/) override {}
  void BeforeTick() override;
  void AfterTick() override;
  void ProposeEdits(std::vector<Edit>* edits) override;
  void Edited(const Edit& edit) override;
  void Save(std::vector<float>* memory) const override;
  void Load(StageMemory* memory) override;

 private:
  void Look();
  b2Body* BodyOf(const Open& open) const {
    return w_.built.bodies[static_cast<std::size_t>(open.assembly)];
  }
  const Part& PartWith(const Open& open) const {
    return w_.scene.parts[static_cast<std::size_t>(open.what.part)];
  }
  bool Meet(const Where& outlet, const Where& inlet) const;

  const StageWorld w_;
  bool stale_ = true;  // parts were joined or broken since the last Look
  std::vector<Open> open_;
  float reach_ = 0;                // m; largest reach
  std::map<PartId, int> waiting_;  // ticks left for parts that were just torn off
  std::set<Meeting> met_;
};

void JoinStage::Look() {
  if (!stale_) return;
  stale_ = false;
  open_.clear();
  reach_ = 0;
  for (const FreeConnector& free : FreeConnectors(w_.scene, w_.composition)) {
    Open open;
    open.what = free;
    open.assembly = w_.composition.assembly_of_part[static_cast<std::size_t>(free.part)];
    const Part& part = PartWith(open);
    const Assembly& whole = w_.composition.assemblies[static_cast<std::size_t>(open.assembly)];
    const Part& root = w_.scene.parts[static_cast<std::size_t>(whole.id)];
    const std::vector<Connector>& own =
        free.inlet ? part.connectors->inlets : part.connectors->outlets;
    const Connector& connector = own[static_cast<std::size_t>(free.index)];
    open.local = ToB2(ToRootFrame(part, root, connector.at.cast<double>()).cast<float>());
    open.turn = part.angle + connector.angle - root.angle;
    reach_ = std::max(reach_, part.connectors->reach);
    open_.push_back(open);
  }
}

void JoinStage::BeforeTick() {
  Look();
  met_.clear();
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    it = --it->second <= 0 ? waiting_.erase(it) : std::next(it);
  }
}

void JoinStage::Edited(const Edit& edit) {
  stale_ = true;
  const BreakEdit* broken = edit.As<BreakEdit>();
  if (broken == nullptr || broken->joint < 0) return;
  if (broken->joint >= static_cast<int>(w_.scene.joints.size())) return;
  const Joint& joint = w_.scene.joints[static_cast<std::size_t>(broken->joint)];
  const auto ticks = static_cast<int>(kJoinAgain * static_cast<float>(w_.scene.solver.tick_hz));
  for (const PartId part : {joint.a, joint.b}) {
    if (!w_.scene.parts[static_cast<std::size_t>(part)].connectors->empty()) waiting_[part] = ticks;
  }
}

bool JoinStage::Meet(const Where& outlet, const Where& inlet) const {
  if (outlet.open->assembly == inlet.open->assembly) return false;
  const b2Body* a = BodyOf(*outlet.open);
  const b2Body* b = BodyOf(*inlet.open);
  const bool moves = (a->GetType() == b2_dynamicBody && a->IsAwake()) ||
                     (b->GetType() == b2_dynamicBody && b->IsAwake());
  if (!moves) return false;
  const b2Vec2 out(Cos(outlet.angle), Sin(outlet.angle));
  if (b2Dot(out, outlet.velocity - inlet.velocity) < kJoinClosing) return false;
  const Connectors& one = *PartWith(*outlet.open).connectors;
  const Connectors& other = *PartWith(*inlet.open).connectors;
  if ((outlet.at - inlet.at).Length() > std::min(one.reach, other.reach)) return false;
  const float away = WrapAngle(outlet.angle - inlet.angle - kPiFloat);
  return std::fabs(away) <= std::min(one.angle, other.angle);
}

void JoinStage::AfterTick() {
  Look();
  std::vector<Where> placed;
  for (const Open& open : open_) {
    if (waiting_.count(open.what.part) != 0) continue;
    const b2Body* body = BodyOf(open);
    if (IsAside(*body)) continue;
    placed.push_back({&open, body->GetWorldPoint(open.local), body->GetAngle() + open.turn,
                      body->GetLinearVelocityFromLocalPoint(open.local)});
  }
  std::sort(placed.begin(), placed.end(),
            [](const Where& x, const Where& y) { return x.at.x < y.at.x; });
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t j = i + 1; j < placed.size(); ++j) {
      if (placed[j].at.x - placed[i].at.x > reach_) break;
      if (placed[i].open->what.inlet == placed[j].open->what.inlet) continue;
      const Where& out = placed[i].open->what.inlet ? placed[j] : placed[i];
      const Where& in = placed[i].open->what.inlet ? placed[i] : placed[j];
      if (!Meet(out, in)) continue;
      met_.insert({(out.at - in.at).Length(), out.open->what.part, out.open->what.index,
                   in.open->what.part, in.open->what.index});
    }
  }
}

void JoinStage::ProposeEdits(std::vector<Edit>* edits) {
  // The poses of assemblies bonded in this tick are not known yet: one bond at a time.
  std::set<int> busy;
  for (const auto& [distance, a, outlet, b, inlet] : met_) {
    const int one = w_.composition.assembly_of_part[static_cast<std::size_t>(a)];
    const int other = w_.composition.assembly_of_part[static_cast<std::size_t>(b)];
    if (one == other || one < 0 || other < 0 || busy.count(one) + busy.count(other) > 0) continue;
    busy.insert({one, other});
    edits->emplace_back(JoinOf(w_.scene.parts[static_cast<std::size_t>(a)], outlet,
                               w_.scene.parts[static_cast<std::size_t>(b)], inlet));
  }
}

void JoinStage::Save(std::vector<float>* memory) const { SaveTicks(waiting_, memory); }

void JoinStage::Load(StageMemory* memory) { LoadTicks(memory, &waiting_); }

}  // namespace

std::unique_ptr<Stage> MakeJoinStage(const StageWorld& world) {
  return std::make_unique<JoinStage>(world);
}

}  // namespace seam
