#include "tests/lab/hard/raw_box2d.h"

#include <box2d/box2d.h>

#include "common/base/bytes.h"
#include "common/physics/world_build.h"

namespace seam {

struct RawBox2d::Impl {
  explicit Impl(const Scene& s) : scene(s), world(ToB2(s.gravity)) {
    world.SetContinuousPhysics(s.solver.continuous);
    world.SetAllowSleeping(s.solver.sleep);
    world.SetWarmStarting(s.solver.warm_starting);
    composition = Compose(scene);
    built = BuildScene(scene, composition, &world);
  }
  const Scene scene;
  Composition composition;
  b2World world;
  BuiltScene built;
  std::int64_t tick = 0;
};

RawBox2d::RawBox2d(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
RawBox2d::~RawBox2d() = default;

void RawBox2d::SetInput(int player, const Input& input) {
  for (Motor& motor : impl_->built.motors) {
    if (motor.player == player) motor.Drive(ShareOf(input, motor.axis));
  }
}

void RawBox2d::Act(int player, int action) {
  const Action& a = impl_->scene.players[static_cast<std::size_t>(player)]
                        .actions[static_cast<std::size_t>(action)];
  const int assembly = impl_->composition.assembly_of_part[static_cast<std::size_t>(a.part)];
  impl_->built.bodies[static_cast<std::size_t>(assembly)]->ApplyLinearImpulseToCenter(
      ToB2(a.impulse), true);
}

void RawBox2d::Step() {
  const Solver& solver = impl_->scene.solver;
  const float h = 1.0f / static_cast<float>(solver.tick_hz * solver.substeps);
  for (int i = 0; i < solver.substeps; ++i) {
    impl_->world.Step(h, solver.velocity_iterations, solver.position_iterations);
  }
  ++impl_->tick;
}

std::int64_t RawBox2d::tick() const { return impl_->tick; }

std::uint64_t RawBox2d::Hash() const {
  std::uint64_t hash = Fnv1a(&impl_->tick, sizeof impl_->tick);
  for (const MovingBody& m : impl_->built.moving) {
    const b2Vec2 p = m.body->GetPosition(), v = m.body->GetLinearVelocity();
    const float fields[] = {p.x, p.y, m.body->GetAngle(), v.x, v.y, m.body->GetAngularVelocity()};
    const char asleep = m.body->IsAwake() ? 0 : 1;
    hash = Fnv1a(&asleep, 1, Fnv1a(fields, sizeof fields, hash));
  }
  return hash;
}

}  // namespace seam
