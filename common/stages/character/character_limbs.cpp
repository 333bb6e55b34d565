#include "common/stages/character/character_limbs.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/scene/character.h"

namespace seam {
namespace {

/// A motor in torque mode runs towards this unreachable spin, rad/s.
constexpr float kSpinBeyond = 1000;
/// Least upward component of the normal of a supporting contact.
constexpr float kBearing = 0.5f;

/// Finds the nearest solid fixture along a ray that is not of the group.
struct Nearest : b2RayCastCallback {
  int16 group = 0;
  GroundPoint ground;
  float ReportFixture(b2Fixture* fixture, const b2Vec2& point, const b2Vec2& normal,
                      float fraction) override {
    if (fixture->IsSensor() || fixture->GetFilterData().groupIndex == group) return -1;
    ground.found = true;
    ground.point = point;
    ground.normal = normal;
    return fraction;
  }
};

}  // namespace

CharacterLimbs::CharacterLimbs(const Character& character, const StageWorld& world)
    : character_(character), world_(world), facing_(character.facing) {
  scale_ = character.height / 1.8f;
  for (float* m :
       {&shape_.hip, &shape_.shoulder, &shape_.neck, &shape_.thigh, &shape_.shank, &shape_.ankle,
        &shape_.heel, &shape_.toe, &shape_.upper_arm, &shape_.lower_arm}) {
    *m *= scale_;
  }
}

void CharacterLimbs::Find(b2World* world) {
  engine_ = world;
  for (int p = 0; p < kCharacterParts; ++p) {
    const auto part = static_cast<std::size_t>(character_.parts[static_cast<std::size_t>(p)]);
    const int assembly = world_.composition.assembly_of_part[part];
    bodies_[p] = assembly < 0 ? nullptr : world_.built.bodies[static_cast<std::size_t>(assembly)];
    if (bodies_[p] != nullptr && IsAside(*bodies_[p])) bodies_[p] = nullptr;
  }
  for (int j = 0; j < kCharacterJoints; ++j) {
    const auto joint = static_cast<std::size_t>(character_.joints[static_cast<std::size_t>(j)]);
    joints_[j] = static_cast<b2RevoluteJoint*>(world_.built.joints[joint]);
    bound_[j] = world_.scene.joints[joint].motor_torque;
  }
  whole_ = bodies_[kTorso] != nullptr;
  for (int j = kHipLeft; j <= kAnkleRight; ++j) whole_ = whole_ && joints_[j] != nullptr;
}

void CharacterLimbs::Forget() {
  engine_ = nullptr;
  std::fill(std::begin(bodies_), std::end(bodies_), nullptr);
  std::fill(std::begin(joints_), std::end(joints_), nullptr);
  whole_ = false;
}

bool CharacterLimbs::dynamic() const {
  return bodies_[kTorso] != nullptr && bodies_[kTorso]->GetType() == b2_dynamicBody;
}

bool CharacterLimbs::awake() const {
  return bodies_[kTorso] != nullptr && bodies_[kTorso]->IsAwake();
}

bool CharacterLimbs::Touches(CharacterPart part, float up_min, b2Vec2* velocity) const {
  b2Body* body = bodies_[part];
  for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
    b2Contact* contact = edge->contact;
    if (!contact->IsTouching() || !contact->IsEnabled()) continue;
    if (contact->GetFixtureA()->IsSensor() || contact->GetFixtureB()->IsSensor()) continue;
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    // The normal points from the first to the second. An obstacle in front gives no support.
    const bool first = contact->GetFixtureA()->GetBody() == body;
    if ((first ? -manifold.normal.y : manifold.normal.y) < up_min) continue;
    *velocity = Own(edge->other->GetLinearVelocityFromWorldPoint(body->GetWorldCenter()));
    return true;
  }
  return false;
}

void CharacterLimbs::SenseLeg(int side, LegSense* leg) const {
  b2RevoluteJoint* hip = joints_[Hip(side)];
  b2RevoluteJoint* ankle = joints_[Ankle(side)];
  leg->hip = Own(hip->GetAnchorA());
  leg->knee = Own(joints_[Knee(side)]->GetAnchorA());
  leg->ankle = Own(ankle->GetAnchorA());
  leg->thigh = facing_ * hip->GetBodyB()->GetAngle();
  leg->shank = facing_ * ankle->GetBodyA()->GetAngle();
  leg->foot = facing_ * ankle->GetBodyB()->GetAngle();
  leg->down = Touches(side == 0 ? kFootLeft : kFootRight, kBearing, &leg->ground_velocity);
}

CharacterSense CharacterLimbs::Sense() const {
  CharacterSense sense;
  for (b2Body* body : bodies_) {
    if (body == nullptr) continue;
    const float mass = body->GetMass();
    sense.mass += mass;
    sense.centre += mass * Own(body->GetWorldCenter());
    sense.velocity += mass * Own(body->GetLinearVelocity());
  }
  sense.centre *= 1 / sense.mass;
  sense.velocity *= 1 / sense.mass;
  for (b2Body* body : bodies_) {
    if (body == nullptr) continue;
    const float own = body->GetInertia() - body->GetMass() * body->GetLocalCenter().LengthSquared();
    sense.turning += facing_ * own * body->GetAngularVelocity() +
                     body->GetMass() * b2Cross(Own(body->GetWorldCenter()) - sense.centre,
                                               Own(body->GetLinearVelocity()) - sense.velocity);
  }
  b2Body* torso = bodies_[kTorso];
  const float turn = facing_ * torso->GetAngle();
  sense.torso = turn - 2 * b2_pi * std::round(turn / (2 * b2_pi));
  sense.torso_spin = facing_ * torso->GetAngularVelocity();
  for (int side = 0; side < 2; ++side) {
    SenseLeg(side, &sense.legs[side]);
    // Whole turns of the torso are removed, so the legs' angles must lose them too.
    for (float* angle :
         {&sense.legs[side].thigh, &sense.legs[side].shank, &sense.legs[side].foot}) {
      *angle += sense.torso - turn;
    }
  }
  sense.hip = sense.legs[0].hip;
  sense.hip_velocity = Own(torso->GetLinearVelocityFromWorldPoint(joints_[kHipLeft]->GetAnchorA()));
  b2Vec2 ignored;
  const bool head = bodies_[kHead] != nullptr && joints_[kNeck] != nullptr;
  sense.lying = Touches(kTorso, kBearing, &ignored) || (head && Touches(kHead, kBearing, &ignored));
  return sense;
}

float CharacterLimbs::angle(CharacterJoint joint) const {
  return facing_ * joints_[joint]->GetJointAngle();
}

void CharacterLimbs::Servo(CharacterJoint joint, float angle, float spin, float stiffness,
                           float damping) {
  b2RevoluteJoint* j = joints_[joint];
  if (j == nullptr) return;
  float missing = angle - this->angle(joint);
  if (!j->IsLimitEnabled()) missing = WrapAngle(missing);  // the shorter way round
  const float there = spin + stiffness / damping * missing;
  const float proposed = damping * (there - facing_ * j->GetJointSpeed());
  told_[joint] = std::clamp(proposed, -bound_[joint], bound_[joint]);
  j->SetMotorSpeed(facing_ * there);
  j->SetMaxMotorTorque(std::abs(told_[joint]));
}

float CharacterLimbs::Torque(CharacterJoint joint, float torque) {
  b2RevoluteJoint* j = joints_[joint];
  if (j == nullptr) return 0;
  told_[joint] = std::clamp(torque, -bound_[joint], bound_[joint]);
  j->SetMotorSpeed(told_[joint] * facing_ > 0 ? kSpinBeyond : -kSpinBeyond);
  j->SetMaxMotorTorque(std::abs(told_[joint]));
  return told_[joint];
}

void CharacterLimbs::Slacken(CharacterJoint joint, float tone) {
  b2RevoluteJoint* j = joints_[joint];
  if (j == nullptr) return;
  told_[joint] = 0;
  j->SetMotorSpeed(0);
  j->SetMaxMotorTorque(tone * character_.slack[static_cast<std::size_t>(joint)]);
}

void CharacterLimbs::SlackenAll(float tone) {
  for (int j = 0; j < kCharacterJoints; ++j) Slacken(static_cast<CharacterJoint>(j), tone);
}

GroundPoint CharacterLimbs::Hit(b2Vec2 from, b2Vec2 to) const {
  Nearest nearest;
  for (b2Body* body : bodies_) {
    if (body != nullptr && body->GetFixtureList() != nullptr) {
      nearest.group = body->GetFixtureList()->GetFilterData().groupIndex;
      break;
    }
  }
  engine_->RayCast(&nearest, Own(from), Own(to));
  nearest.ground.point = Own(nearest.ground.point);
  nearest.ground.normal = Own(nearest.ground.normal);
  return nearest.ground;
}

}  // namespace seam
