/// World: motion of bodies that are displayed and not simulated. A kinematic body hits like a wall
/// of infinite mass, and in a closed room that pumps energy into everything that it touches. A body
/// on a prescribed path is solved like any other, with its own mass, and put back on its path
/// afterwards.

#include <algorithm>
#include <utility>

#include "common/physics/flight/solid.h"
#include "common/physics/world_impl.h"

namespace seam {
namespace {

/// Converts the velocity of the body's origin to that of its centre of mass.
b2Vec2 AtCentre(const b2Body& body, const b2Vec2& at_origin) {
  const b2Vec2 arm = body.GetWorldCenter() - body.GetPosition();
  return at_origin + b2Cross(body.GetAngularVelocity(), arm);
}

/// True if a joint keeps two bodies from colliding.
bool Tied(const b2Body& body, const b2Body& other) {
  for (const b2JointEdge* edge = body.GetJointList(); edge != nullptr; edge = edge->next) {
    if (edge->other == &other && !edge->joint->GetCollideConnected()) return true;
  }
  return false;
}

/// Returns the overlap of two solid shapes without their rims, m. 0 for any other shapes.
float ShapeOverlap(const b2Shape& a, const b2Transform& at_a, const b2Shape& b,
                   const b2Transform& at_b) {
  const auto circle = [](const b2Shape& s) { return static_cast<const b2CircleShape*>(&s); };
  const auto polygon = [](const b2Shape& s) { return static_cast<const b2PolygonShape*>(&s); };
  const bool round_a = a.GetType() == b2Shape::e_circle, round_b = b.GetType() == b2Shape::e_circle;
  const bool flat_a = a.GetType() == b2Shape::e_polygon, flat_b = b.GetType() == b2Shape::e_polygon;
  if (!(round_a || flat_a) || !(round_b || flat_b)) return 0;
  if (round_a && flat_b) return ShapeOverlap(b, at_b, a, at_a);
  b2Manifold manifold;
  manifold.pointCount = 0;
  if (round_a) {
    b2CollideCircles(&manifold, circle(a), at_a, circle(b), at_b);
  } else if (round_b) {
    b2CollidePolygonAndCircle(&manifold, polygon(a), at_a, circle(b), at_b);
  } else {
    b2CollidePolygons(&manifold, polygon(a), at_a, polygon(b), at_b);
  }
  if (manifold.pointCount == 0) return 0;
  b2WorldManifold points;
  points.Initialize(&manifold, at_a, a.m_radius, at_b, b.m_radius);
  const float rims = (flat_a ? a.m_radius : 0) + (flat_b ? b.m_radius : 0);
  float deepest = 0;
  for (int i = 0; i < manifold.pointCount; ++i) {
    deepest = std::max(deepest, -points.separations[i] - rims);
  }
  return deepest;
}

/// Finds the nearest anchored fixture that collides with one of the body's.
class FirstAnchored : public b2RayCastCallback {
 public:
  explicit FirstAnchored(const b2Body& body) : body_(body) {}

  float ReportFixture(b2Fixture* fixture, const b2Vec2&, const b2Vec2&, float fraction) override {
    const b2Body& other = *fixture->GetBody();
    if (!IsSolidAndAnchored(*fixture) || !Collides(*fixture) || Tied(body_, other)) return -1;
    share = fraction;
    return fraction;
  }

  float share = 1;

 private:
  bool Collides(const b2Fixture& other) const {
    for (const b2Fixture* own = body_.GetFixtureList(); own != nullptr; own = own->GetNext()) {
      if (!own->IsSensor() && Collide(*own, other)) return true;
    }
    return false;
  }

  const b2Body& body_;
};

}  // namespace

void World::SetActivity(int body, Activity activity) {
  const MovingBody& m = impl_->moving(body);
  Activity& stored = impl_->activities[static_cast<std::size_t>(body)];
  const Activity before = std::exchange(stored, activity);
  impl_->as_built = impl_->as_built && before == activity;
  const bool was_there = IsPresent(before), is_there = IsPresent(activity);
  if (before == activity || (!was_there && !is_there)) return;
  touches();  // as they are after the last tick
  blocked_directions();
  if (activity == Activity::kDormant) impl_->RememberContacts(body);
  const bool sleeps_on = before == Activity::kDormant && !m.body->IsAwake();
  b2Vec2 origin_velocity = m.body->GetLinearVelocity();  // as for bodies on a path
  if (before == Activity::kSimulated) {
    origin_velocity = m.body->GetLinearVelocityFromLocalPoint(b2Vec2(0, 0));
  }
  const bool crosses = was_there != is_there;
  if (crosses) impl_->Cross(body, !is_there);
  if (activity == Activity::kKinematic && !crosses) {
    m.body->SetType(b2_kinematicBody);  // forgets the centre of mass
    m.body->SetLinearVelocity(origin_velocity);
  } else {
    if (before == Activity::kKinematic && !crosses) {
      m.body->SetType(b2_dynamicBody);
      m.body->SetMassData(&m.mass);
    }
    const bool dynamic = activity == Activity::kSimulated;
    if (dynamic && (crosses || !impl_->scene.solver.sleep)) m.body->SetAwake(true);
    m.body->SetLinearVelocity(dynamic ? AtCentre(*m.body, origin_velocity) : origin_velocity);
  }
  if (sleeps_on) SetAwake(body, false);
  impl_->prescribed_count +=
      (activity == Activity::kPrescribed ? 1 : 0) - (before == Activity::kPrescribed ? 1 : 0);
}

const std::vector<int>& World::present() const { return impl_->present; }
std::int64_t World::looks() const { return impl_->looks; }

void World::Impl::FindPresent(bool aside) {
  present.clear();
  crossed.clear();
  awake_aside.clear();
  listed_awake.assign(activities.size(), 0);
  for (std::size_t i = 0; i < activities.size(); ++i) {
    const auto body = static_cast<int>(i);
    if (IsPresent(activities[i])) {
      present.push_back(body);
    } else if (!aside) {
      crossed.push_back(body);
    }
  }
}

/// Records that a body comes or goes, which the next rebuild carries out.
void World::Impl::Cross(int body, bool goes) {
  unsettled = true;
  crossed.push_back(body);
  MarkAside(body);
  const auto at = std::lower_bound(present.begin(), present.end(), body);
  if (goes) {
    present.erase(at);
  } else {
    present.insert(at, body);
  }
}

void World::Impl::InvalidatePages() {
  kept.Resize(built.moving.size());
  stale.assign(kept.page_count(), 1);
  changed.assign(kept.size(), 1);
  stamps.assign(kept.size(), ++last_stamp);
  std::size_t size = 256;
  while (size < 2 * kept.size()) size *= 2;
  change_log.assign(size, 0);
  log_from = last_stamp;
}

void World::Impl::MarkAside(int body) {
  const auto i = static_cast<std::size_t>(body);
  NoteChanged(body);
  if (listed_awake[i] != 0 || !built.moving[i].body->IsAwake()) return;
  listed_awake[i] = 1;
  awake_aside.push_back(body);
}

void World::Impl::MarkAllAside() {
  if (present.size() == activities.size()) return;
  for (std::size_t i = 0; i < activities.size(); ++i) MarkAside(static_cast<int>(i));
}

void World::Impl::MarkPresent() {
  for (const int body : present) NoteChanged(body);
}

std::uint64_t World::still(int body) const {
  const auto i = static_cast<std::size_t>(body);
  SEAM_ASSERT(body >= 0 && i < impl_->activities.size());
  const bool aside = !IsPresent(impl_->activities[i]) && i < impl_->memory.goes_aside.size() &&
                     impl_->memory.goes_aside[i] != 0;
  return aside && impl_->listed_awake[i] == 0 ? impl_->stamps[i] : 0;
}

std::uint64_t World::last_change() const { return impl_->last_stamp; }

bool World::ChangedSince(std::uint64_t change, std::vector<int>* bodies) const {
  const std::size_t size = impl_->change_log.size();
  if (change < impl_->log_from || impl_->last_stamp - change > size) return false;
  for (std::uint64_t stamp = change + 1; stamp <= impl_->last_stamp; ++stamp) {
    bodies->push_back(impl_->change_log[stamp & (size - 1)]);
  }
  return true;
}

Activity World::activity(int body) const {
  const auto i = static_cast<std::size_t>(body);
  SEAM_ASSERT(body >= 0 && i < impl_->activities.size());
  return impl_->activities[i];
}

void World::Impl::BeginPrescribedStep() {
  prescribed_from.resize(built.moving.size());
  for (const int index : present) {
    const auto i = static_cast<std::size_t>(index);
    if (activities[i] != Activity::kPrescribed) continue;
    b2Body* body = built.moving[i].body;
    const b2Vec2 velocity = body->GetLinearVelocity();
    prescribed_from[i] = {FromB2(body->GetPosition()), body->GetAngle(), FromB2(velocity),
                          body->GetAngularVelocity()};
    if (body->IsAwake()) body->SetLinearVelocity(AtCentre(*body, velocity));
  }
}

void World::Impl::EndPrescribedStep(float h) {
  for (const int index : present) {
    const auto i = static_cast<std::size_t>(index);
    if (activities[i] != Activity::kPrescribed) continue;
    b2Body* body = built.moving[i].body;
    if (!body->IsAwake()) continue;
    const BodyState& from = prescribed_from[i];
    body->SetTransform(ToB2(from.position + h * from.velocity), from.angle + h * from.spin);
    body->SetLinearVelocity(ToB2(from.velocity));
    body->SetAngularVelocity(from.spin);
  }
}

/// Moves the bodies that are aside and awake; sleeping ones cost nothing.
void World::Impl::MoveAside() {
  const float dt = 1.0f / static_cast<float>(scene.solver.tick_hz);
  std::size_t awake = 0;
  for (const int index : awake_aside) {
    b2Body* body = moving(index).body;
    const auto i = static_cast<std::size_t>(index);
    listed_awake[i] = 0;
    if (!IsAside(*body) || !body->IsAwake()) continue;
    NoteChanged(index);
    const bool turns = body->GetAngularVelocity() != 0;
    if (!turns && body->GetLinearVelocity() == b2Vec2(0, 0)) body->SetAwake(false);
    body->SetTransform(body->GetPosition() + dt * body->GetLinearVelocity(),
                       body->GetAngle() + dt * body->GetAngularVelocity());
    if (!body->IsAwake()) continue;
    listed_awake[i] = 1;
    awake_aside[awake++] = index;
  }
  awake_aside.resize(awake);
}

float World::FreeWay(int body, const Vec2& from, const Vec2& to) const {
  const b2Vec2 begin = ToB2(from), end = ToB2(to);
  if ((end - begin).LengthSquared() <= 0) return 1;
  FirstAnchored first(*impl_->moving(body).body);
  impl_->world->RayCast(&first, begin, end);
  return first.share;
}

float World::OverlapAt(int a, const BodyState& pose_a, int b, const BodyState& pose_b) const {
  const b2Body &body_a = *impl_->moving(a).body, &body_b = *impl_->moving(b).body;
  if (Tied(body_a, body_b)) return 0;
  const b2Transform at_a(ToB2(pose_a.position), b2Rot(pose_a.angle));
  const b2Transform at_b(ToB2(pose_b.position), b2Rot(pose_b.angle));
  float deepest = 0;
  b2ContactFilter filter;
  for (const b2Fixture* fa = body_a.GetFixtureList(); fa != nullptr; fa = fa->GetNext()) {
    for (const b2Fixture* fb = body_b.GetFixtureList(); fb != nullptr; fb = fb->GetNext()) {
      if (!filter.ShouldCollide(const_cast<b2Fixture*>(fa), const_cast<b2Fixture*>(fb))) continue;
      deepest = std::max(deepest, ShapeOverlap(*fa->GetShape(), at_a, *fb->GetShape(), at_b));
    }
  }
  return deepest;
}

BodyState World::AfterFlight(int body, const BodyState& from, float seconds) const {
  const MovingBody& moving = impl_->moving(body);
  impl_->flight.Begin(*impl_->world, *moving.body, moving.mass, impl_->step_s());
  return impl_->flight.After(from, seconds);
}

bool World::Impl::Holds(std::size_t joint) const {
  if (built.joints[joint] != nullptr) return true;
  return all_present && all_present->made[joint] != 0 && !scene.joints[joint].gone;
}

std::vector<bool> World::Impl::AllHeld() const {
  std::vector<bool> held;
  for (std::size_t j = 0; j < built.joints.size(); ++j) held.push_back(Holds(j));
  return held;
}

/// Stores the joints as they are while no body is aside.
void World::Impl::SaveAllJoints(bool any_aside) {
  if (!any_aside) return all_present.reset();
  if (all_present) return;
  all_present.emplace();
  all_present->pins = FindPins();
  for (const b2Joint* joint : built.joints) all_present->made.push_back(joint != nullptr ? 1 : 0);
}

}  // namespace seam
