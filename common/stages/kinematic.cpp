#include "common/stages/kinematic.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/geometry.h"
#include "common/base/trig.h"
#include "common/physics/engine_members.h"
#include "common/physics/stage.h"

namespace seam {
namespace {

using Eigen::Vector2d;

class KinematicStage : public Stage {
 public:
  explicit KinematicStage(const StageWorld& world) : world_(world) {}

  void Rebuilt(b2World* /*world*/) override {
    motions_.emplace(world_.scene, world_.composition);
    bodies_.clear();
    for (int i = 0; i < motions_->count(); ++i) {
      bodies_.push_back(world_.built.bodies[static_cast<std::size_t>(motions_->assembly(i))]);
    }
    Place();
  }
  void Emptied() override { bodies_.clear(); }
  void TickSet() override { Place(); }
  void BeforeTick() override { substep_ = 0; }
  void BeforeStep(float h) override {
    ++substep_;
    const double part = 1.0 / world_.scene.solver.substeps;
    const double to = static_cast<double>(world_.tick) + substep_ * part;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodyState now = motions_->At(static_cast<int>(i), to - part);
      const BodyState next = motions_->At(static_cast<int>(i), to);
      b2Body* body = bodies_[i];
      const b2Vec2 mean = (1 / h) * (ToB2(next.position) - body->GetPosition());
      body->SetLinearVelocity(mean);
      body->SetAngularVelocity((next.angle - body->GetAngle()) / h);
      // m/s2: for soft contacts, which step it in parts (SoftStep::Fixed). The engine ignores it.
      body->*Member(BodyForce()) = 2 / h * (mean - ToB2(now.velocity));
    }
  }
  void AfterTick() override { Place(); }

 private:
  void Place() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodyState now = motions_->At(static_cast<int>(i), static_cast<double>(world_.tick));
      b2Body* body = bodies_[i];
      const bool there =
          FromB2(body->GetPosition()) == now.position && body->GetAngle() == now.angle;
      if (!there) body->SetTransform(ToB2(now.position), now.angle);
      body->SetLinearVelocity(ToB2(now.velocity));  // also for an edit, and after a barrier
      body->SetAngularVelocity(now.spin);
    }
  }

  const StageWorld world_;
  std::optional<ImposedMotions> motions_;
  std::vector<b2Body*> bodies_;  // by index of motions_
  int substep_ = 0;
};

}  // namespace

ImposedMotions::ImposedMotions(const Scene& scene, const Composition& composition)
    : tick_s_(1.0 / scene.solver.tick_hz) {
  for (std::size_t i = 0; i < composition.assemblies.size(); ++i) {
    const Assembly& assembly = composition.assemblies[i];
    if (assembly.kinematic < 0) continue;
    const Joint& joint = scene.joints[static_cast<std::size_t>(assembly.kinematic)];
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    Motion motion;
    motion.assembly = static_cast<int>(i);
    motion.pivot = joint.anchor_b.cast<double>();
    motion.arm = root.position.cast<double>() - motion.pivot;
    motion.angle = static_cast<double>(root.angle);
    motion.turning = static_cast<double>(joint.turning);
    motion.period_s = joint.period_s;
    motion.phase = joint.phase;
    motion.ease = joint.ease;
    for (const Vec2& point : joint.path) motion.path.push_back(point.cast<double>());
    double length = 0;
    for (std::size_t k = 0; k < motion.path.size(); ++k) {
      length += (motion.path[(k + 1) % motion.path.size()] - motion.path[k]).norm();
      motion.ends.push_back(length);
    }
    motions_.push_back(std::move(motion));
  }
}

int ImposedMotions::assembly(int index) const {
  return motions_[static_cast<std::size_t>(index)].assembly;
}

int ImposedMotions::IndexOf(int assembly) const {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    if (motions_[i].assembly == assembly) return static_cast<int>(i);
  }
  return -1;
}

BodyState ImposedMotions::At(int index, double tick) const {
  const Motion& m = motions_[static_cast<std::size_t>(index)];
  const double t = tick * tick_s_;
  Vector2d place{0, 0}, velocity{0, 0};
  if (!m.path.empty()) {
    const double laps = t / m.period_s + m.phase;
    const double way = (laps - std::floor(laps)) * m.ends.back();  // m since the first point
    std::size_t leg = 0;
    while (leg + 1 < m.ends.size() && way >= m.ends[leg]) ++leg;
    const double from = leg == 0 ? 0 : m.ends[leg - 1], length = m.ends[leg] - from;
    const Vector2d along = m.path[(leg + 1) % m.path.size()] - m.path[leg];
    // A leg of zero length lasts no longer than an instant.
    const double u = length > 0 ? std::min(1.0, (way - from) / length) : 0;
    const double share = m.ease ? (1 - Cos(kPi * u)) / 2 : u;
    const double pace = m.ease ? kPi / 2 * Sin(kPi * u) : 1;
    place = m.path[leg] + share * along;
    if (length > 0) velocity = pace * m.ends.back() / m.period_s / length * along;
  }
  const double turned = m.turning * t;
  const Vector2d arm = Turned(m.arm, turned);
  velocity += m.turning * Vector2d(-arm.y(), arm.x());
  BodyState state;
  state.position = (m.pivot + place + arm).cast<float>();
  state.angle = static_cast<float>(m.angle + turned);
  state.velocity = velocity.cast<float>();
  state.spin = static_cast<float>(m.turning);
  return state;
}

std::unique_ptr<Stage> MakeKinematicStage(const StageWorld& world) {
  return std::make_unique<KinematicStage>(world);
}

}  // namespace seam
