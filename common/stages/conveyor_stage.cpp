#include <algorithm>

#include "common/physics/world_shapes.h"
#include "common/scene/forces.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

class ConveyorStage : public Stage {
 public:
  explicit ConveyorStage(const StageWorld& world)
      : world_(world), inputs_(world.scene.players.size() + world.scene.seats.size()) {}

  void Rebuilt(b2World* /*world*/) override {
    // Speeds depend only on inputs and edits: a barrier, which a client takes at every other tick,
    // changes no belt.
    if (revision_ != world_.topology.revision()) FindBelts();
  }
  void SetInput(int player, const Input& input) override {
    Input& last = inputs_[static_cast<std::size_t>(player)];
    if (last == input) return;
    last = input;
    const auto [first, end] =
        std::equal_range(belts_.begin(), belts_.end(), Belt{player, 0},
                         [](const Belt& x, const Belt& y) { return x.player < y.player; });
    for (auto belt = first; belt != end; ++belt) {
      if (Set(PartAt(belt->part))) WakeTouchingBodies(PartAt(belt->part));
    }
  }
  bool listens() const override { return true; }
  void PreSolve(b2Contact* contact) override {
    const float a = SpeedOf(contact->GetFixtureA()), b = SpeedOf(contact->GetFixtureB());
    // The engine drives B against A along the right-hand side of the normal from A to B: clockwise
    // around A, and for A, seen from B, clockwise around B.
    if (a != 0 || b != 0 || contact->GetTangentSpeed() != 0) contact->SetTangentSpeed(a + b);
  }

 private:
  struct Belt {
    int player = -1;  // or seat; -1: always on
    PartId part = 0;
  };

  const Part& PartAt(PartId id) const { return world_.scene.parts[static_cast<std::size_t>(id)]; }
  void FindBelts() {
    revision_ = world_.topology.revision();
    speeds_.assign(world_.scene.parts.size(), 0);
    belts_.clear();
    for (const Part& part : world_.scene.parts) {
      if (part.conveyor->speed == 0) continue;
      belts_.push_back({part.conveyor->player, part.id});
      Set(part);
    }
    std::stable_sort(belts_.begin(), belts_.end(),
                     [](const Belt& x, const Belt& y) { return x.player < y.player; });
  }
  /// Updates the part's speed; returns true if it has changed.
  bool Set(const Part& part) {
    const Conveyor& c = *part.conveyor;
    const float share =
        c.player < 0 ? 1 : ShareOf(inputs_[static_cast<std::size_t>(c.player)], c.axis);
    float& speed = speeds_[static_cast<std::size_t>(part.id)];
    const float before = speed;
    speed = share * c.speed;
    return speed != before;
  }
  float SpeedOf(const b2Fixture* fixture) const {
    const std::size_t part = PartOf(fixture);
    return part < speeds_.size() ? speeds_[part] : 0;  // fixtures of stages are not parts
  }
  void WakeTouchingBodies(const Part& part) {
    const int assembly = world_.composition.assembly_of_part[static_cast<std::size_t>(part.id)];
    if (assembly < 0) return;
    b2Body* body = world_.built.bodies[static_cast<std::size_t>(assembly)];
    if (IsAside(*body)) return;  // out of the world: no contacts
    for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
      if (edge->contact->IsTouching()) edge->other->SetAwake(true);
    }
    if (body->GetType() == b2_dynamicBody) body->SetAwake(true);
  }

  const StageWorld world_;
  std::vector<Input> inputs_;  // by player, then by seat
  std::vector<float> speeds_;  // by part, m/s
  std::vector<Belt> belts_;    // parts with a conveyor, by player
  int revision_ = -1;          // revision of the scene for the above
};

}  // namespace

std::unique_ptr<Stage> MakeConveyorStage(const StageWorld& world) {
  return std::make_unique<ConveyorStage>(world);
}

}  // namespace seam
