#include "common/physics/world.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/bytes.h"
#include "common/base/check.h"

namespace seam {
namespace {

b2Vec2 ToB2(const Vec2& v) { return b2Vec2(v.x(), v.y()); }
Vec2 FromB2(const b2Vec2& v) { return Vec2(v.x, v.y); }

/// Index among the moving bodies, -1 for anchored ones.
int IndexOf(b2Body* body) { return static_cast<int>(body->GetUserData().pointer) - 1; }

/// Sums the normal impulses of a tick by pair of bodies.
class ImpulseMeter : public b2ContactListener {
 public:
  struct Sum {
    float impulse = 0;
    b2Vec2 point{0, 0};
  };
  std::map<std::pair<int, int>, Sum> sums;   // by body indices, a < b; -1 anchored

  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    int a = IndexOf(contact->GetFixtureA()->GetBody());
    int b = IndexOf(contact->GetFixtureB()->GetBody());
    if (a > b) std::swap(a, b);
    float total = 0;
    for (int i = 0; i < impulse->count; ++i) total += impulse->normalImpulses[i];
    if (total <= 0) return;
    Sum& sum = sums[{a, b}];
    sum.impulse += total;
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    sum.point = manifold.points[0];
  }
};

}  // namespace

struct World::Impl {
  explicit Impl(const Scene& s) : scene(s), composition(Compose(s)), world(ToB2(s.gravity)) {}

  const Scene scene;
  const Composition composition;
  b2World world;
  ImpulseMeter meter;
  std::int64_t tick = 0;
  struct Moving {
    b2Body* body = nullptr;
    PartId id = 0;
    int mechanism = 0;
    float mass = 0;
  };
  std::vector<Moving> moving;
  std::vector<int> body_of_assembly;   // index of composition.assemblies -> moving, -1
  std::vector<b2Body*> all;            // by assembly
  struct Motor {
    b2Joint* joint = nullptr;
    const Joint* spec = nullptr;
  };
  std::vector<Motor> motors;
  std::vector<Impact> impacts;
  std::vector<Touch> touches;
  std::vector<Block> blocks;
  std::vector<b2DistanceJoint*> tethers;   // to anchored bodies

  void BuildAssembly(const Assembly& assembly);
  void AddFixture(b2Body* body, const Part& root, const Part& part);
  void BuildJoint(const Joint& joint);
  void Drive(const Motor& motor, int drive);
  void NoteImpacts();
  void NoteContacts();
  void AddBlock(int body, const Vec2& normal);
  b2Body* BodyOfPart(PartId part) {
    return all[static_cast<std::size_t>(
        composition.assembly_of_part[static_cast<std::size_t>(part)])];
  }
};

void World::Impl::AddFixture(b2Body* body, const Part& root, const Part& part) {
  b2FixtureDef def;
  def.density = part.material.density;
  def.friction = part.material.friction;
  def.restitution = part.material.restitution;
  def.filter.groupIndex = static_cast<int16>(part.group);
  const b2Transform root_frame(ToB2(root.position), b2Rot(root.angle));
  const b2Vec2 center = b2MulT(root_frame, ToB2(part.position));
  const float angle = part.angle - root.angle;
  const b2Transform local(center, b2Rot(angle));
  b2PolygonShape polygon;
  b2CircleShape circle;
  b2ChainShape chain;
  std::vector<b2Vec2> points;
  for (const Vec2& p : part.points) points.push_back(b2Mul(local, ToB2(p)));
  switch (part.kind) {
    case ShapeKind::kBox:
      polygon.SetAsBox(part.size.x() / 2, part.size.y() / 2, center, angle);
      def.shape = &polygon;
      break;
    case ShapeKind::kCircle:
      circle.m_radius = part.radius;
      circle.m_p = center;
      def.shape = &circle;
      break;
    case ShapeKind::kPolygon:
      polygon.Set(points.data(), static_cast<int32>(points.size()));
      def.shape = &polygon;
      break;
    case ShapeKind::kChain: {
      // The scene's open side is on the left of the way along the points, Box2D's on the right.
      std::reverse(points.begin(), points.end());
      const b2Vec2 before = points[0] - (points[1] - points[0]);
      const b2Vec2 after = points.back() + (points.back() - points[points.size() - 2]);
      chain.CreateChain(points.data(), static_cast<int32>(points.size()), before, after);
      def.shape = &chain;
      break;
    }
  }
  body->CreateFixture(&def);
}

void World::Impl::BuildAssembly(const Assembly& assembly) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  b2BodyDef def;
  def.type = assembly.anchored ? b2_staticBody : b2_dynamicBody;
  def.position = ToB2(root.position);
  def.angle = root.angle;
  def.allowSleep = scene.solver.sleep;
  if (!assembly.anchored) {
    def.linearVelocity = ToB2(root.velocity);
    def.angularVelocity = root.spin;
    def.userData.pointer = moving.size() + 1;
  }
  for (PartId p : assembly.parts) {
    def.bullet = def.bullet || scene.parts[static_cast<std::size_t>(p)].bullet;
  }
  b2Body* body = world.CreateBody(&def);
  for (PartId p : assembly.parts) {
    AddFixture(body, root, scene.parts[static_cast<std::size_t>(p)]);
  }
  all.push_back(body);
  body_of_assembly.push_back(assembly.anchored ? -1 : static_cast<int>(moving.size()));
  if (!assembly.anchored) {
    moving.push_back({body, assembly.id, assembly.mechanism, body->GetMass()});
  }
}

void World::Impl::BuildJoint(const Joint& joint) {
  b2Body* a = BodyOfPart(joint.a);
  b2Body* b = BodyOfPart(joint.b);
  if (joint.kind == JointKind::kWeld || a == b) return;
  b2Joint* made = nullptr;
  switch (joint.kind) {
    case JointKind::kWeld: break;
    case JointKind::kRevolute: {
      b2RevoluteJointDef def;
      def.Initialize(a, b, ToB2(joint.anchor_a));
      def.enableLimit = joint.limited;
      def.lowerAngle = joint.lower;
      def.upperAngle = joint.upper;
      def.enableMotor = joint.motor_torque > 0;
      def.maxMotorTorque = joint.motor_torque;
      def.collideConnected = joint.collide;
      made = world.CreateJoint(&def);
      break;
    }
    case JointKind::kWheel: {
      b2WheelJointDef def;
      def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.axis));
      def.enableMotor = joint.motor_torque > 0;
      def.maxMotorTorque = joint.motor_torque;
      def.collideConnected = joint.collide;
      if (joint.frequency_hz > 0) {
        b2LinearStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
      }
      made = world.CreateJoint(&def);
      break;
    }
    case JointKind::kDistance: {
      b2DistanceJointDef def;
      def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.anchor_b));
      if (joint.length > 0) def.length = joint.length;
      def.minLength = def.maxLength = def.length;
      if (joint.frequency_hz > 0) {
        b2LinearStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
        def.minLength = 0;
        def.maxLength = 1e6f;
      }
      def.collideConnected = joint.collide;
      made = world.CreateJoint(&def);
      break;
    }
  }
  if (joint.motor_torque > 0) motors.push_back({made, &joint});
  const bool anchored = a->GetType() == b2_staticBody || b->GetType() == b2_staticBody;
  if (joint.kind == JointKind::kDistance && joint.frequency_hz <= 0 && anchored) {
    tethers.push_back(static_cast<b2DistanceJoint*>(made));
  }
}

void World::Impl::Drive(const Motor& motor, int drive) {
  // A positive drive goes to the right: wheels turn clockwise.
  const float speed = motor.spec->motor_speed * static_cast<float>(drive) / 127.0f;
  if (motor.spec->kind == JointKind::kWheel) {
    static_cast<b2WheelJoint*>(motor.joint)->SetMotorSpeed(speed);
  } else if (motor.spec->kind == JointKind::kRevolute) {
    static_cast<b2RevoluteJoint*>(motor.joint)->SetMotorSpeed(speed);
  }
}

World::World(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {
  Impl& w = *impl_;
  w.world.SetContinuousPhysics(scene.solver.continuous);
  w.world.SetAllowSleeping(scene.solver.sleep);
  w.world.SetContactListener(&w.meter);
  for (const Assembly& a : w.composition.assemblies) w.BuildAssembly(a);
  for (const Joint& j : w.scene.joints) w.BuildJoint(j);
  for (const Impl::Motor& m : w.motors) w.Drive(m, m.spec->motor_player < 0 ? 127 : 0);
}

World::~World() = default;

const Scene& World::scene() const { return impl_->scene; }
const Composition& World::composition() const { return impl_->composition; }
int World::body_count() const { return static_cast<int>(impl_->moving.size()); }
PartId World::id(int body) const { return impl_->moving[static_cast<std::size_t>(body)].id; }

int World::BodyOfId(PartId assembly) const {
  const auto& m = impl_->moving;
  const auto it = std::lower_bound(m.begin(), m.end(), assembly,
                                   [](const Impl::Moving& a, PartId id) { return a.id < id; });
  return it != m.end() && it->id == assembly ? static_cast<int>(it - m.begin()) : -1;
}

int World::mechanism(int body) const {
  return impl_->moving[static_cast<std::size_t>(body)].mechanism;
}
float World::mass(int body) const { return impl_->moving[static_cast<std::size_t>(body)].mass; }
std::int64_t World::tick() const { return impl_->tick; }
void World::SetTick(std::int64_t tick) { impl_->tick = tick; }
float World::dt() const { return 1.0f / static_cast<float>(impl_->scene.solver.tick_hz); }

BodyState World::Read(int body) const {
  const b2Body* b = impl_->moving[static_cast<std::size_t>(body)].body;
  BodyState s;
  s.position = FromB2(b->GetPosition());
  s.angle = b->GetAngle();
  s.velocity = FromB2(b->GetLinearVelocity());
  s.spin = b->GetAngularVelocity();
  return s;
}

void World::Write(int body, const BodyState& s, bool wake) {
  SEAM_ASSERT(s.position.allFinite() && s.velocity.allFinite());
  SEAM_ASSERT(std::isfinite(s.angle) && std::isfinite(s.spin));
  b2Body* b = impl_->moving[static_cast<std::size_t>(body)].body;
  if (FromB2(b->GetPosition()) != s.position || b->GetAngle() != s.angle) {
    b->SetTransform(ToB2(s.position), s.angle);
  }
  const bool was_awake = b->IsAwake();
  b->SetLinearVelocity(ToB2(s.velocity));   // wakes a sleeping body if not zero
  b->SetAngularVelocity(s.spin);
  if (!was_awake && !wake) b->SetAwake(false);
  if (wake) b->SetAwake(true);
}

bool World::awake(int body) const {
  return impl_->moving[static_cast<std::size_t>(body)].body->IsAwake();
}
void World::SetAwake(int body, bool awake) {
  impl_->moving[static_cast<std::size_t>(body)].body->SetAwake(awake);
}

void World::SetMotion(int body, Motion motion) {
  b2Body* b = impl_->moving[static_cast<std::size_t>(body)].body;
  const b2BodyType type = motion == Motion::kDynamic ? b2_dynamicBody : b2_kinematicBody;
  if (b->GetType() != type) b->SetType(type);
}
Motion World::motion(int body) const {
  const b2Body* b = impl_->moving[static_cast<std::size_t>(body)].body;
  return b->GetType() == b2_dynamicBody ? Motion::kDynamic : Motion::kKinematic;
}

void World::SetInput(int player, const Input& input) {
  for (const Impl::Motor& m : impl_->motors) {
    if (m.spec->motor_player == player) impl_->Drive(m, input.drive);
  }
}

void World::Act(int player, int action) {
  const Action& a = impl_->scene.players[static_cast<std::size_t>(player)]
                        .actions[static_cast<std::size_t>(action)];
  impl_->BodyOfPart(a.part)->ApplyLinearImpulseToCenter(ToB2(a.impulse), true);
}

void World::Step() {
  Impl& w = *impl_;
  const Solver& s = w.scene.solver;
  w.meter.sums.clear();
  const float h = 1.0f / static_cast<float>(s.tick_hz * s.substeps);
  for (int i = 0; i < s.substeps; ++i) {
    w.world.Step(h, s.velocity_iterations, s.position_iterations);
  }
  ++w.tick;
  w.NoteImpacts();
  w.NoteContacts();
}

void World::Impl::NoteImpacts() {
  impacts.clear();
  for (const auto& [pair, sum] : meter.sums) {
    float dv = 0;
    for (int body : {pair.first, pair.second}) {
      if (body >= 0) dv = std::max(dv, sum.impulse / moving[static_cast<std::size_t>(body)].mass);
    }
    if (dv < kImpactRecordMin) continue;
    impacts.push_back({pair.first, pair.second, FromB2(sum.point), dv});
  }
}

void World::Impl::AddBlock(int body, const Vec2& normal) {
  int same_body = 0;
  for (const Block& b : blocks) {
    if (b.body != body) continue;
    if (std::fabs(b.normal.dot(normal)) > 0.9f) return;   // that direction is blocked already
    ++same_body;
  }
  if (same_body < 2) blocks.push_back({body, normal});
}

void World::Impl::NoteContacts() {
  touches.clear();
  blocks.clear();
  for (b2Contact* c = world.GetContactList(); c != nullptr; c = c->GetNext()) {
    if (!c->IsTouching() || c->GetManifold()->pointCount == 0) continue;
    int a = IndexOf(c->GetFixtureA()->GetBody());
    int b = IndexOf(c->GetFixtureB()->GetBody());
    if (a < 0 && b < 0) continue;
    if (a < 0 || b < 0) {
      b2WorldManifold manifold;
      c->GetWorldManifold(&manifold);
      AddBlock(std::max(a, b), FromB2(manifold.normal));
      continue;
    }
    if (a > b) std::swap(a, b);
    touches.push_back({a, b});
  }
  for (b2DistanceJoint* tether : tethers) {
    const b2Vec2 along = tether->GetAnchorB() - tether->GetAnchorA();
    const float length = along.Length();
    if (length <= 0) continue;
    const int a = IndexOf(tether->GetBodyA());
    const int b = IndexOf(tether->GetBodyB());
    AddBlock(std::max(a, b), FromB2((1 / length) * along));
  }
  const auto less = [](const Touch& x, const Touch& y) {
    return x.body_a != y.body_a ? x.body_a < y.body_a : x.body_b < y.body_b;
  };
  const auto equal = [](const Touch& x, const Touch& y) {
    return x.body_a == y.body_a && x.body_b == y.body_b;
  };
  std::sort(touches.begin(), touches.end(), less);
  touches.erase(std::unique(touches.begin(), touches.end(), equal), touches.end());
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const Block& x, const Block& y) { return x.body < y.body; });
}

const std::vector<Block>& World::blocks() const { return impl_->blocks; }
const std::vector<Impact>& World::impacts() const { return impl_->impacts; }
const std::vector<Touch>& World::touches() const { return impl_->touches; }

std::uint64_t World::Hash() const {
  std::uint64_t hash = Fnv1a(&impl_->tick, sizeof impl_->tick);
  for (int body = 0; body < body_count(); ++body) {
    const BodyState s = Read(body);
    const float fields[] = {s.position.x(), s.position.y(), s.angle,
                            s.velocity.x(), s.velocity.y(), s.spin};
    hash = Fnv1a(fields, sizeof fields, hash);
    const char asleep = awake(body) ? 0 : 1;
    hash = Fnv1a(&asleep, 1, hash);
  }
  return hash;
}

double World::Energy() const {
  double energy = 0;
  const Vec2& g = impl_->scene.gravity;
  for (const Impl::Moving& m : impl_->moving) {
    const b2Vec2 v = m.body->GetLinearVelocity();
    const b2Vec2 c = m.body->GetWorldCenter();
    const double spin = m.body->GetAngularVelocity();
    const b2Vec2 local = static_cast<const b2Body*>(m.body)->GetLocalCenter();
    const double about_center =
        m.body->GetInertia() - m.mass * b2Dot(local, local);
    energy += 0.5 * m.mass * (static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y) +
              0.5 * about_center * spin * spin -
              m.mass * (static_cast<double>(g.x()) * c.x + static_cast<double>(g.y()) * c.y);
  }
  return energy;
}

}  // namespace seam
