#include <algorithm>
#include <cmath>

#include "common/scene/water.h"
#include "common/stages/make_stages.h"
#include "common/stages/water/displaced.h"
#include "common/stages/water/propeller_law.h"
#include "common/stages/water/water_push.h"

namespace seam {
namespace {

class PropellerStage : public Stage {
 public:
  explicit PropellerStage(const StageWorld& world) : world_(world) {
    for (std::size_t i = 0; i < world.scene.thrusts.size(); ++i) {
      const Thrust& thrust = world.scene.thrusts[i];
      if (thrust.screw.diameter <= 0) continue;
      Mounted mounted;
      mounted.thrust = i;
      mounted.share = thrust.player < 0 ? 1.0f : 0.0f;
      mounted_.push_back(mounted);
    }
  }

  void Rebuilt(b2World* /*world*/) override {
    for (Mounted& mounted : mounted_) {
      const Thrust& thrust = Of(mounted);
      const auto id = static_cast<std::size_t>(thrust.part);
      const int index = world_.composition.assembly_of_part[id];
      mounted.body = nullptr;
      if (index < 0) continue;
      const auto place = static_cast<std::size_t>(index);
      const Part& part = world_.scene.parts[id];
      const Part& root =
          world_.scene.parts[static_cast<std::size_t>(world_.composition.assemblies[place].id)];
      mounted.body = world_.built.bodies[place];
      if (IsAside(*mounted.body)) mounted.body = nullptr;
      mounted.at = ToB2(ToRootFrame(part, root, thrust.at.cast<double>()).cast<float>());
      mounted.along = b2Mul(b2Rot(part.angle - root.angle), ToB2(thrust.force));
    }
  }
  void Emptied() override {
    for (Mounted& mounted : mounted_) mounted.body = nullptr;
  }
  void SetInput(int player, const Input& input) override {
    for (Mounted& mounted : mounted_) {
      const Thrust& thrust = Of(mounted);
      if (thrust.player != player) continue;
      const float share = ShareOf(input, thrust.axis);
      if (share == mounted.share) continue;
      mounted.share = share;
      if (mounted.body != nullptr) mounted.body->SetAwake(true);
    }
  }
  void BeforeStep(float h) override {
    for (const Mounted& mounted : mounted_) {
      if (mounted.body == nullptr || !mounted.body->IsAwake()) continue;
      for (const Water& water : world_.scene.waters) Turn(mounted, water, h);
    }
  }

 private:
  /// A propeller on its body.
  struct Mounted {
    std::size_t thrust = 0;        // index into the scene's
    b2Body* body = nullptr;        // nullptr: its part is gone
    b2Vec2 at{0, 0}, along{1, 0};  // in the body's frame
    float share = 0;               // of its turns, -1..1
  };

  const Thrust& Of(const Mounted& mounted) const { return world_.scene.thrusts[mounted.thrust]; }

  /// Applies one propeller in one water. The force acts at the middle of the disc's part in the
  /// water.
  void Turn(const Mounted& mounted, const Water& water, float h) {
    const Screw& screw = Of(mounted).screw;
    b2Body& body = *mounted.body;
    const Vec2d middle = FromB2(body.GetWorldPoint(mounted.at)).cast<double>();
    const Vec2d along = FromB2(body.GetWorldVector(mounted.along)).cast<double>();
    const Vec2d across(-along.y(), along.x());
    const double radius = static_cast<double>(screw.diameter) / 2;
    Vec2d from = middle - radius * across, to = middle + radius * across;
    if (!Shorten(BoundsOf(water), &from, &to)) return;
    const b2Vec2 at = ToB2(Vec2d((from + to) / 2).cast<float>());
    const Vec2d velocity =
        FromB2(body.GetLinearVelocityFromWorldPoint(at)).cast<double>() - water.flow.cast<double>();
    const auto pitch = static_cast<double>(screw.pitch);
    const double span =
        EffectiveSpan(pitch, (from - middle).dot(across), (to - middle).dot(across));
    const double drag =
        static_cast<double>(water.density) * static_cast<double>(water.drag_normal) / 2;
    const double turns = static_cast<double>(mounted.share) * static_cast<double>(screw.turns);
    const double speed = velocity.dot(along);
    // At most the force that ends the slip within the step: a light body would shake.
    const double most = static_cast<double>(body.GetMass()) / static_cast<double>(h) *
                        std::fabs(turns * pitch - speed);
    const double thrust = std::clamp(PropellerThrust(screw, span, drag, turns, speed), -most, most);
    body.ApplyForce(ToB2((thrust * along).cast<float>()), at, false);
  }

  const StageWorld world_;
  std::vector<Mounted> mounted_;
};

}  // namespace

std::unique_ptr<Stage> MakePropellerStage(const StageWorld& world) {
  return std::make_unique<PropellerStage>(world);
}

}  // namespace seam
