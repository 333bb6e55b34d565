#include <algorithm>
#include <map>

#include "common/scene/water.h"
#include "common/stages/make_stages.h"
#include "common/stages/water/water_push.h"

namespace seam {
namespace {

/// Steps for which a new body, or one that was kinematic, may be in water without a contact: the
/// engine finds the contacts of a body that becomes dynamic at the end of a step, and processes
/// them in the next.
constexpr int kStepsUnseen = 2;

/// A body's shape and cells, computed when it first gets wet.
struct Wettable {
  WetShape shape;
  std::map<int, WetCells> cells;  // by their number
};

struct Unseen {
  int body = 0;
  int steps = kStepsUnseen;  // left
};

class WaterStage : public Stage {
 public:
  explicit WaterStage(const StageWorld& world) : w_(world) {}

  void Rebuilt(b2World* world) override;
  void Placed() override;
  void Emptied() override { pool_ = nullptr; }
  void BeforeTick() override;
  void BeforeStep(float h) override;
  void AfterTick() override { RecordMotions(); }
  bool listens() const override { return true; }
  void BeginContact(b2Contact* contact) override { Count(contact, 1); }
  void EndContact(b2Contact* contact) override { Count(contact, -1); }

 private:
  void Count(b2Contact* contact, int change);
  void RecordMotions();
  int& Touching(int body, std::size_t water) {
    return touching_[static_cast<std::size_t>(body) * w_.scene.waters.size() + water];
  }
  Wettable& WettableOf(int body);
  void Push(int body, bool unseen, float h);
  bool IsNear(b2Body* body) const;

  const StageWorld w_;
  b2Body* pool_ = nullptr;     // anchored, with one sensor for each water
  std::vector<int> touching_;  // fixtures in contact, by body and water
  std::vector<int> wet_;       // bodies in any water, ascending
  std::vector<Unseen> unseen_;
  std::vector<char> kinematic_;       // by body, after the last tick
  std::uint64_t composition_ = 0;     // composition of the shapes below
  std::map<int, Wettable> wettable_;  // by body
};

void WaterStage::Rebuilt(b2World* world) {
  const FeatureList<Water>& waters = w_.scene.waters;
  touching_.assign(w_.built.moving.size() * waters.size(), 0);
  wet_.clear();
  unseen_.clear();
  if (composition_ != w_.composition.hash) wettable_.clear();
  composition_ = w_.composition.hash;
  const b2BodyDef still;
  pool_ = world->CreateBody(&still);
  for (std::size_t i = 0; i < waters.size(); ++i) {
    const Vec2 half = (waters[i].max - waters[i].min) / 2;
    const Vec2 centre = (waters[i].max + waters[i].min) / 2;
    b2PolygonShape box;
    box.SetAsBox(half.x(), half.y(), ToB2(centre), 0);
    b2FixtureDef def;
    def.shape = &box;
    def.isSensor = true;
    def.userData.pointer = kStageFixture + i;
    pool_->CreateFixture(&def);
  }
  RecordMotions();
  for (std::size_t i = 0; i < kinematic_.size(); ++i) unseen_.push_back({static_cast<int>(i)});
}

/// Motions are set by now, and contacts are found before the next step.
void WaterStage::Placed() {
  RecordMotions();
  unseen_.clear();
}

void WaterStage::RecordMotions() {
  kinematic_.clear();
  for (const MovingBody& m : w_.built.moving) {
    kinematic_.push_back(m.body->GetType() == b2_kinematicBody);
  }
}

void WaterStage::Count(b2Contact* contact, int change) {
  b2Fixture* water = contact->GetFixtureA();
  b2Fixture* other = contact->GetFixtureB();
  if (other->GetBody() == pool_) std::swap(water, other);
  const int body = IndexOf(other->GetBody());
  if (water->GetBody() != pool_ || body < 0) return;
  const std::size_t index = water->GetUserData().pointer - kStageFixture;
  Touching(body, index) += change;
  int all = 0;
  for (std::size_t i = 0; i < w_.scene.waters.size(); ++i) all += Touching(body, i);
  const auto at = std::lower_bound(wet_.begin(), wet_.end(), body);
  const bool listed = at != wet_.end() && *at == body;
  if (all > 0 && !listed) wet_.insert(at, body);
  if (all == 0 && listed) wet_.erase(at);
}

void WaterStage::BeforeTick() {
  for (std::size_t i = 0; i < kinematic_.size(); ++i) {
    const MovingBody& m = w_.built.moving[i];
    if (kinematic_[i] && m.body->GetType() == b2_dynamicBody) {
      unseen_.push_back({static_cast<int>(i)});
    }
  }
}

Wettable& WaterStage::WettableOf(int body) {
  const auto found = wettable_.find(body);
  if (found != wettable_.end()) return found->second;
  const PartId id = w_.built.moving[static_cast<std::size_t>(body)].id;
  const int assembly = w_.composition.assembly_of_part[static_cast<std::size_t>(id)];
  Wettable made;
  made.shape = WetShapeOf(w_.scene, w_.composition.assemblies[static_cast<std::size_t>(assembly)]);
  for (const Water& water : w_.scene.waters) {
    if (water.method != Buoyancy::kVoxel || made.cells.count(water.cells) != 0) continue;
    made.cells[water.cells] = CellsOf(made.shape, water.cells);
  }
  return wettable_[body] = std::move(made);
}

/// Returns true if a joint or contact may hold the body against a flow.
bool IsHeld(b2Body* body) {
  if (body->GetJointList() != nullptr) return true;
  for (const b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    const bool sensor =
        edge->contact->GetFixtureA()->IsSensor() || edge->contact->GetFixtureB()->IsSensor();
    if (!sensor && edge->contact->IsTouching()) return true;
  }
  return false;
}

FloatingBody AsFloating(const b2Body& b) {
  const b2Transform& pose = b.GetTransform();
  const auto mass = static_cast<double>(b.GetMass());
  const Vec2d local = FromB2(b.GetLocalCenter()).cast<double>();
  return {FromB2(pose.p).cast<double>(),
          {static_cast<double>(pose.q.c), static_cast<double>(pose.q.s)},
          FromB2(b.GetWorldCenter()).cast<double>(),
          FromB2(b.GetLinearVelocity()).cast<double>(),
          static_cast<double>(b.GetAngularVelocity()),
          mass,
          static_cast<double>(b.GetInertia()) - mass * local.dot(local)};
}

/// Returns true if the engine's boxes around the body's fixtures overlap any water.
bool WaterStage::IsNear(b2Body* body) const {
  for (b2Fixture* fixture = body->GetFixtureList(); fixture != nullptr;
       fixture = fixture->GetNext()) {
    const b2AABB& box = fixture->GetAABB(0);
    for (const Water& water : w_.scene.waters) {
      if (b2TestOverlap(box, b2AABB{ToB2(water.min), ToB2(water.max)})) return true;
    }
  }
  return false;
}

void WaterStage::Push(int body, bool unseen, float h) {
  b2Body* b = w_.built.moving[static_cast<std::size_t>(body)].body;
  if (IsAside(*b) || b->GetType() != b2_dynamicBody || (unseen && !IsNear(b))) return;
  const auto in = [&](std::size_t i) { return unseen || Touching(body, i) > 0; };
  for (std::size_t i = 0; i < w_.scene.waters.size(); ++i) {
    // A body that drifts too slowly for the engine must not fall asleep on the way.
    if (in(i) && w_.scene.waters[i].flow != Vec2(0, 0) && !IsHeld(b)) b->SetAwake(true);
  }
  if (!b->IsAwake()) return;
  Wettable& wettable = WettableOf(body);
  const FloatingBody floating = AsFloating(*b);
  const Vec2d gravity = w_.scene.gravity.cast<double>();
  WaterSum sum(floating, gravity);
  for (std::size_t i = 0; i < w_.scene.waters.size(); ++i) {
    const Water& water = w_.scene.waters[i];
    if (!in(i)) continue;
    const bool voxel = water.method == Buoyancy::kVoxel;
    sum.Add(wettable.shape, voxel ? &wettable.cells[water.cells] : nullptr, water);
  }
  if (sum.empty()) return;
  const seam::Push push = sum.Over(static_cast<double>(h));
  b->ApplyForceToCenter(ToB2(push.force.cast<float>()), false);
  b->ApplyTorque(static_cast<float>(push.torque), false);
}

void WaterStage::BeforeStep(float h) {
  for (const int body : wet_) Push(body, false, h);
  for (Unseen& one : unseen_) {
    const bool seen = std::binary_search(wet_.begin(), wet_.end(), one.body);
    if (!seen) Push(one.body, true, h);
    --one.steps;
  }
  unseen_.erase(std::remove_if(unseen_.begin(), unseen_.end(),
                               [](const Unseen& one) { return one.steps <= 0; }),
                unseen_.end());
}

}  // namespace

std::unique_ptr<Stage> MakeWaterStage(const StageWorld& world) {
  return std::make_unique<WaterStage>(world);
}

}  // namespace seam
