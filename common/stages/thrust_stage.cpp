#include "common/scene/forces.h"
#include "common/stages/make_stages.h"

namespace seam {
namespace {

class ThrustStage : public Stage {
 public:
  explicit ThrustStage(const StageWorld& world) : world_(world) {
    for (const Thrust& thrust : world.scene.thrusts) {
      engines_.push_back({nullptr, {0, 0}, {0, 0}, thrust.player < 0 ? 1.0f : 0.0f});
    }
  }

  void Rebuilt(b2World* /*world*/) override {
    for (std::size_t i = 0; i < engines_.size(); ++i) {
      const Thrust& thrust = world_.scene.thrusts[i];
      const auto id = static_cast<std::size_t>(thrust.part);
      const int index = world_.composition.assembly_of_part[id];
      Engine& engine = engines_[i];
      engine.body = nullptr;
      if (index < 0 || thrust.screw.diameter > 0) continue;  // MakePropellerStage
      const auto place = static_cast<std::size_t>(index);
      const Part& part = world_.scene.parts[id];
      const Part& root =
          world_.scene.parts[static_cast<std::size_t>(world_.composition.assemblies[place].id)];
      const float turn = part.angle - root.angle;
      engine.body = world_.built.bodies[place];
      if (IsAside(*engine.body)) engine.body = nullptr;
      engine.at = ToB2(ToRootFrame(part, root, thrust.at.cast<double>()).cast<float>());
      engine.force = b2Mul(b2Rot(turn), ToB2(thrust.force));
    }
  }
  void Emptied() override {
    for (Engine& engine : engines_) engine.body = nullptr;
  }
  void SetInput(int player, const Input& input) override {
    for (std::size_t i = 0; i < engines_.size(); ++i) {
      const Thrust& thrust = world_.scene.thrusts[i];
      if (thrust.player != player) continue;
      const bool pressed = thrust.button >= 0 && ((input.buttons >> thrust.button) & 1) != 0;
      const float share = thrust.button < 0 ? ShareOf(input, thrust.axis) : pressed ? 1.0f : 0.0f;
      Engine& engine = engines_[i];
      if (share == engine.share) continue;
      engine.share = share;
      if (engine.body != nullptr) engine.body->SetAwake(true);
    }
  }
  void BeforeStep(float /*h*/) override {
    for (const Engine& engine : engines_) {
      if (engine.body == nullptr || engine.share == 0) continue;
      engine.body->ApplyForce(engine.share * engine.body->GetWorldVector(engine.force),
                              engine.body->GetWorldPoint(engine.at), false);
    }
  }

 private:
  struct Engine {
    b2Body* body = nullptr;        // nullptr: its part is gone
    b2Vec2 at{0, 0}, force{0, 0};  // in the body's frame
    float share = 0;               // of the force, -1..1
  };
  const StageWorld world_;
  std::vector<Engine> engines_;  // by index into the scene's thrusts
};

}  // namespace

std::unique_ptr<Stage> MakeThrustStage(const StageWorld& world) {
  return std::make_unique<ThrustStage>(world);
}

}  // namespace seam
