#include "common/physics/world_build.h"

#include <cfloat>

#include "common/base/check.h"
#include "common/physics/faces.h"
#include "common/physics/world_shapes.h"

namespace seam {
namespace {

b2Body* AddBody(const Scene& scene, const Assembly& assembly, b2World* world,
                std::map<PartId, std::vector<PartId>>* merged) {
  const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
  b2BodyDef def;
  def.type = assembly.anchored ? b2_staticBody : b2_dynamicBody;
  def.position = ToB2(root.position);
  def.angle = root.angle;
  for (const PartId id : assembly.parts) {
    def.bullet = def.bullet || scene.parts[static_cast<std::size_t>(id)].bullet;
  }
  b2Body* body = world->CreateBody(&def);
  const bool guarded = assembly.anchored || def.bullet;
  for (const Face& face : FacesOf(scene, assembly)) {
    AddFixture(face.shape, root, scene.solver.skin, guarded, body);
    if (face.parts.size() > 1) (*merged)[face.shape.id] = face.parts;
  }
  return body;
}

b2MassData MassDataOf(const Scene& scene, const Assembly& assembly) {
  const MassProperties own = AssemblyProperties(scene, assembly);
  b2MassData data;
  data.mass = static_cast<float>(own.mass);
  data.center = ToB2(own.centre.cast<float>());
  data.I = static_cast<float>(own.inertia + own.mass * own.centre.dot(own.centre));
  // Box2D subtracts again and asserts that something is left. Something is: the root is the
  // heaviest of at most 4096 parts, so its distance to the centre is part of the inertia.
  SEAM_ASSERT(own.inertia > 1e-5 * own.mass * own.centre.dot(own.centre));
  return data;
}

/// Where bonds have moved an end's place, the ends are no longer one point of the scene.
template <typename Def>
void SetEnds(const Joint& joint, b2Body* b, Def* def) {
  def->localAnchorB = b->GetLocalPoint(ToB2(joint.anchor_b));
}

b2Joint* AddRevolute(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2RevoluteJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a));
  SetEnds(joint, b, &def);
  def.referenceAngle -= joint.turn;
  def.enableLimit = joint.limited;
  def.lowerAngle = joint.lower;
  def.upperAngle = joint.upper;
  def.enableMotor = joint.motor_torque > 0;
  def.maxMotorTorque = joint.motor_torque;
  def.collideConnected = joint.collide;
  return world->CreateJoint(&def);
}

b2Joint* AddWheel(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2WheelJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.axis));
  SetEnds(joint, b, &def);
  if (joint.frequency_hz > 0) {
    b2LinearStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
  } else {
    // Without a spring Box2D would let the wheel slide along the axis: hold it.
    def.enableLimit = true;
    def.lowerTranslation = def.upperTranslation = 0;
  }
  def.enableMotor = joint.motor_torque > 0;
  def.maxMotorTorque = joint.motor_torque;
  def.collideConnected = joint.collide;
  return world->CreateJoint(&def);
}

b2Joint* AddDistance(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2DistanceJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a), ToB2(joint.anchor_b));
  if (joint.length > 0) def.length = joint.length;
  def.minLength = def.maxLength = def.length;
  if (joint.frequency_hz > 0) {
    // Box2D's spring works only between unequal limits.
    b2LinearStiffness(def.stiffness, def.damping, joint.frequency_hz, joint.damping_ratio, a, b);
    def.minLength = 0;
    def.maxLength = FLT_MAX;
  }
  def.collideConnected = joint.collide;
  return world->CreateJoint(&def);
}

b2Joint* AddWeld(const Joint& joint, b2Body* a, b2Body* b, b2World* world) {
  b2WeldJointDef def;
  def.Initialize(a, b, ToB2(joint.anchor_a));
  SetEnds(joint, b, &def);
  def.referenceAngle -= joint.turn;
  return world->CreateJoint(&def);
}

b2Joint* AddJoint(const Scene& scene, const Joint& joint, b2Body* a, b2Body* b, b2World* world,
                  BuiltScene* built) {
  if (a == b || (IndexOf(a) < 0 && IndexOf(b) < 0)) return nullptr;   // nothing to hold
  b2Joint* made = nullptr;
  switch (joint.kind) {
    case JointKind::kWeld:
      if (!scene.solver.weld_joints) return nullptr;
      made = AddWeld(joint, a, b, world);
      break;
    case JointKind::kGlue: return nullptr;
    case JointKind::kRevolute: made = AddRevolute(joint, a, b, world); break;
    case JointKind::kWheel: made = AddWheel(joint, a, b, world); break;
    case JointKind::kDistance: made = AddDistance(joint, a, b, world); break;
  }
  if (joint.motor_torque > 0) {
    built->motors.push_back({made, joint.kind == JointKind::kWheel, joint.motor_player,
                             joint.motor_speed, static_cast<int>(built->joints.size())});
  }
  const bool anchored = IndexOf(a) < 0 || IndexOf(b) < 0;
  if (joint.kind == JointKind::kDistance && joint.frequency_hz <= 0 && anchored) {
    built->tethers.push_back(static_cast<b2DistanceJoint*>(made));
  }
  return made;
}

}  // namespace

void Motor::Drive(float share) const { SetSpeed(share * speed); }

void Motor::SetSpeed(float now) const {
  if (wheel) {
    static_cast<b2WheelJoint*>(joint)->SetMotorSpeed(now);
  } else {
    static_cast<b2RevoluteJoint*>(joint)->SetMotorSpeed(now);
  }
}

float Motor::Speed() const {
  return wheel ? static_cast<b2WheelJoint*>(joint)->GetMotorSpeed()
               : static_cast<b2RevoluteJoint*>(joint)->GetMotorSpeed();
}

int IndexOf(b2Body* body) { return static_cast<int>(body->GetUserData().pointer) - 1; }

BuiltScene BuildScene(const Scene& scene, const Composition& composition, b2World* world) {
  BuiltScene built;
  for (const Assembly& assembly : composition.assemblies) {
    b2Body* body = AddBody(scene, assembly, world, &built.merged);
    built.bodies.push_back(body);
    if (assembly.anchored) continue;
    const b2MassData mass = MassDataOf(scene, assembly);
    built.moving.push_back({body, assembly.id, assembly.mechanism, mass});
    body->GetUserData().pointer = built.moving.size();
    body->SetMassData(&mass);
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    body->SetLinearVelocity(ToB2(root.velocity));
    body->SetAngularVelocity(root.spin);
  }
  const auto body_of = [&](PartId part) {
    const int assembly = composition.assembly_of_part[static_cast<std::size_t>(part)];
    return built.bodies[static_cast<std::size_t>(assembly)];
  };
  for (const Joint& joint : scene.joints) {
    if (joint.gone) {
      built.joints.push_back(nullptr);
      continue;
    }
    built.joints.push_back(
        AddJoint(scene, joint, body_of(joint.a), body_of(joint.b), world, &built));
  }
  for (const Motor& motor : built.motors) motor.Drive(motor.player < 0 ? 1.0f : 0.0f);
  return built;
}

}  // namespace seam
