#include "common/physics/world.h"

#include <box2d/b2_timer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/physics/anchored/anchored_bodies.h"
#include "common/physics/world_impl.h"

// Replaces the engine's timer. The engine reads the clock six times for each island, for a profile
// that is not used here: an eighth of the time of a client with balls in the air. The linker
// prefers a program's own functions to those of a shared library, if that can see them.
#define SEAM_SEEN __attribute__((visibility("default")))
SEAM_SEEN b2Timer::b2Timer() : m_start_sec(0), m_start_usec(0) {}
SEAM_SEEN void b2Timer::Reset() {}
SEAM_SEEN float b2Timer::GetMilliseconds() const { return 0; }
#undef SEAM_SEEN

namespace seam {
namespace {

/// Stricter than ==: 0 and -0 would give peers two different poses.
bool SameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

World::World(const Scene& scene) : impl_(std::make_unique<Impl>(Topology(scene))) {}
World::World(const Topology& topology) : impl_(std::make_unique<Impl>(topology)) {}
World::~World() = default;

const Scene& World::scene() const { return impl_->scene; }
const Composition& World::composition() const { return impl_->composition; }
const Topology& World::topology() const { return impl_->topology; }
int World::body_count() const { return static_cast<int>(impl_->built.moving.size()); }
PartId World::id(int body) const { return impl_->moving(body).id; }
int World::mechanism(int body) const { return impl_->moving(body).mechanism; }
float World::mass(int body) const { return impl_->moving(body).mass.mass; }
std::int64_t World::tick() const { return impl_->tick; }
void World::SetTick(std::int64_t tick) {
  impl_->as_built = false;
  impl_->tick = tick;
  for (const auto& stage : impl_->stages) stage->TickSet();
}
float World::dt() const { return 1.0f / static_cast<float>(impl_->scene.solver.tick_hz); }

int World::BodyOfId(PartId assembly) const {
  const auto part = static_cast<std::size_t>(assembly);  // negative numbers become large
  return part < impl_->body_of_id.size() ? impl_->body_of_id[part] : -1;
}

BodyState World::Read(int body) const {
  const b2Body* b = impl_->moving(body).body;
  return {FromB2(b->GetPosition()), b->GetAngle(), FromB2(b->GetLinearVelocity()),
          b->GetAngularVelocity()};
}

void World::Write(int body, const BodyState& state, bool wake) {
  // The setters below do not check: one NaN would spread to everything that this body touches.
  SEAM_ASSERT(state.position.allFinite() && state.velocity.allFinite());
  SEAM_ASSERT(std::isfinite(state.angle) && std::isfinite(state.spin));
  b2Body* b = impl_->moving(body).body;
  const bool was_awake = b->IsAwake();
  const BodyState now = Read(body);
  const bool wakes = wake && !was_awake;
  impl_->as_built = impl_->as_built && !wakes && std::memcmp(&now, &state, sizeof now) == 0;
  // SetTransform moves the body's proxies but keeps its contacts and their impulses for as long as
  // the fattened boxes (0.1 m) still overlap.
  if (!SameBits(now.position.x(), state.position.x()) ||
      !SameBits(now.position.y(), state.position.y()) || !SameBits(now.angle, state.angle)) {
    b->SetTransform(ToB2(state.position), state.angle);
  }
  // Setting a velocity restarts the sleep timer: do so only for a new one.
  if (!SameBits(now.velocity.x(), state.velocity.x()) ||
      !SameBits(now.velocity.y(), state.velocity.y())) {
    b->SetLinearVelocity(ToB2(state.velocity));
  }
  if (!SameBits(now.spin, state.spin)) b->SetAngularVelocity(state.spin);
  if (wakes) b->SetAwake(true);
  if (!wake && !was_awake) b->SetAwake(false);
  if (IsAside(*b)) impl_->MarkAside(body);
}

bool World::awake(int body) const { return impl_->moving(body).body->IsAwake(); }
void World::SetAwake(int body, bool awake) {
  b2Body* b = impl_->moving(body).body;
  const bool sleeps = impl_->scene.solver.sleep || activity(body) != Activity::kSimulated;
  if (!awake && !sleeps) return;
  impl_->as_built = impl_->as_built && !awake && !b->IsAwake();
  b->SetAwake(awake);
  if (IsAside(*b)) impl_->MarkAside(body);
}

std::pair<Vec2, Vec2> World::Bounds(int body) const {
  const b2Body* b = impl_->moving(body).body;
  b2AABB all;
  all.lowerBound = all.upperBound = b->GetPosition();
  bool first = true;
  for (const b2Fixture* f = b->GetFixtureList(); f != nullptr; f = f->GetNext()) {
    for (int32 child = 0; child < f->GetShape()->GetChildCount(); ++child) {
      b2AABB one;
      f->GetShape()->ComputeAABB(&one, b->GetTransform(), child);
      if (first) all = one;
      first = false;
      all.Combine(one);
    }
  }
  return {FromB2(all.lowerBound), FromB2(all.upperBound)};
}

void World::SetInput(int player, const Input& input) {
  const std::vector<Seat>& seats = impl_->scene.seats;
  if (seats.empty()) return Follow(player, input);
  bool sits = false;
  for (std::size_t s = 0; s < seats.size(); ++s) {
    if (seats[s].player != player) continue;
    sits = true;
    Follow(static_cast<int>(impl_->scene.players.size() + s), input);
  }
  Follow(player, sits ? Input{} : input);
}

void World::Follow(int player, const Input& input) {
  impl_->as_built = false;
  for (Motor& motor : impl_->built.motors) {
    if (motor.player == player) motor.Drive(ShareOf(input, motor.axis));
  }
  for (const auto& stage : impl_->stages) stage->SetInput(player, input);
}

void World::Act(int player, int action) {
  const Scene& scene = impl_->scene;
  SEAM_ASSERT(player >= 0 && player < static_cast<int>(scene.players.size()));
  const std::vector<Action>& actions = scene.players[static_cast<std::size_t>(player)].actions;
  SEAM_ASSERT(action >= 0 && action < static_cast<int>(actions.size()));
  const Action& a = actions[static_cast<std::size_t>(action)];
  const int assembly = impl_->composition.assembly_of_part[static_cast<std::size_t>(a.part)];
  if (assembly < 0) return;  // the part is gone
  impl_->built.bodies[static_cast<std::size_t>(assembly)]->ApplyLinearImpulseToCenter(
      ToB2(a.impulse), true);
  impl_->as_built = false;
  impl_->MarkAllAside();
}

void World::Step() {
  Impl& w = *impl_;
  const Solver& solver = w.scene.solver;
  const float h = w.step_s();
  w.Settle();
  w.as_built = false;
  w.meter.Clear();
  if (w.touch_log) w.touch_log->BeginTick();
  DropFarContacts(&*w.world);
  for (const auto& stage : w.stages) stage->BeforeTick();
  for (int i = 0; i < solver.substeps; ++i) {
    if (w.touch_log) w.touch_log->BeginSubstep(i);
    for (const auto& stage : w.stages) stage->BeforeStep(h);
    if (w.prescribed_count > 0) w.BeginPrescribedStep();
    FindNewContactsInOrder(&*w.world);
    if (solver.sleep) w.slow.Before(w.present, w.built);
    if (w.exact) {
      w.exact->Step(h, solver.velocity_iterations, solver.position_iterations);
    } else {
      w.world->Step(h, solver.velocity_iterations, solver.position_iterations);
    }
    OrderNewContacts(&*w.world);
    if (solver.sleep) w.slow.After(w.present, w.activities, w.built, h);
    if (w.prescribed_count > 0) w.EndPrescribedStep(h);
  }
  if (w.touch_log) w.touch_log->EndTick(*w.world);
  if (!w.scene.seats.empty()) w.MarkAllAside();  // a stage may have moved a body there
  w.MoveAside();
  ++w.tick;
  for (const auto& stage : w.stages) stage->AfterTick();
  w.impacts = w.meter.Impacts(w.built.moving);
  w.touches.reset();
  w.blocked_directions.reset();
}

std::vector<Edit> World::ProposeEdits() const {
  std::vector<Edit> edits;
  for (const auto& stage : impl_->stages) stage->ProposeEdits(&edits);
  return edits;
}

const std::vector<Impact>& World::impacts() const { return impl_->impacts; }

const std::vector<Touch>& World::touches() const {
  if (!impl_->touches) impl_->touches = FindTouches(*impl_->world);
  return *impl_->touches;
}

std::vector<PartTouch> World::PartTouches() const {
  return FindPartTouches(*impl_->world, impl_->scene, impl_->built);
}

void World::WatchTouches() {
  Impl& w = *impl_;
  if (w.touch_log) return;
  w.as_built = false;
  w.touch_log.emplace(w.scene, w.built);
  w.meter.Watch(&*w.touch_log);
  w.touch_log->Rebuilt(*w.world, {});
}

const std::vector<PartTouch>& World::begun_touches() const {
  static const std::vector<PartTouch> kNone;
  return impl_->touch_log ? impl_->touch_log->begun() : kNone;
}

const std::vector<BlockedDirection>& World::blocked_directions() const {
  if (!impl_->blocked_directions)
    impl_->blocked_directions = FindBlockedDirections(*impl_->world, impl_->built.tethers);
  return *impl_->blocked_directions;
}

WorldSnapshot World::Keep() { return impl_->Keep(); }

std::uint64_t World::Hash() const {
  std::uint64_t hash = Fnv1a(&impl_->tick, sizeof impl_->tick);
  for (int body = 0; body < body_count(); ++body) {
    const BodyState s = Read(body);
    const float fields[] = {s.position.x(), s.position.y(), s.angle,
                            s.velocity.x(), s.velocity.y(), s.spin};
    const char asleep = awake(body) ? 0 : 1;
    hash = Fnv1a(&asleep, 1, Fnv1a(fields, sizeof fields, hash));
  }
  return hash;
}

double World::Energy() const {
  const Eigen::Vector2d gravity = impl_->scene.gravity.cast<double>();
  double energy = 0;
  for (const MovingBody& m : impl_->built.moving) {
    const Eigen::Vector2d local = FromB2(m.mass.center).cast<double>();
    const Eigen::Vector2d centre = Transform2{FromB2(m.body->GetPosition()).cast<double>(),
                                              static_cast<double>(m.body->GetAngle())}(local);
    const Eigen::Vector2d velocity = FromB2(m.body->GetLinearVelocity()).cast<double>();
    const double spin = static_cast<double>(m.body->GetAngularVelocity());
    const double mass = static_cast<double>(m.mass.mass);
    const double inertia = static_cast<double>(m.mass.I) - mass * local.dot(local);
    energy += mass * velocity.dot(velocity) / 2 + inertia * spin * spin / 2;
    energy -= static_cast<double>(m.body->GetGravityScale()) * mass * gravity.dot(centre);
  }
  return energy;
}

}  // namespace seam
