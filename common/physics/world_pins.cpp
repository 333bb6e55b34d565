/// World: its joints as pins. Springs and motors are left out, but their joints' limits are
/// included.

#include <algorithm>
#include <cfloat>
#include <limits>

#include "common/physics/world_impl.h"

namespace seam {
namespace {

constexpr float kNoEnd = std::numeric_limits<float>::infinity();

void TurnsFreely(Pin* pin) {
  pin->angle_lower = -kNoEnd;
  pin->angle_upper = kNoEnd;
}

void KeepsAngle(float angle, Pin* pin) { pin->angle_lower = pin->angle_upper = angle; }

template <class Made>
void SetPoints(const Made& made, Pin* pin) {
  pin->a.point = FromB2(made.GetLocalAnchorA());
  pin->b.point = FromB2(made.GetLocalAnchorB());
}

void SetRevolute(const b2RevoluteJoint& made, Pin* pin) {
  SetPoints(made, pin);
  TurnsFreely(pin);
  if (!made.IsLimitEnabled()) return;
  pin->angle_lower = made.GetReferenceAngle() + made.GetLowerLimit();
  pin->angle_upper = made.GetReferenceAngle() + made.GetUpperLimit();
}

void SetWeld(const b2WeldJoint& made, Pin* pin) {
  SetPoints(made, pin);
  TurnsFreely(pin);
  if (made.GetStiffness() <= 0) KeepsAngle(made.GetReferenceAngle(), pin);
}

template <class Made>
void SetLine(const Made& made, Pin* pin) {
  SetPoints(made, pin);
  pin->axis = FromB2(made.GetLocalAxisA());
  pin->lower = made.IsLimitEnabled() ? made.GetLowerLimit() : -kNoEnd;
  pin->upper = made.IsLimitEnabled() ? made.GetUpperLimit() : kNoEnd;
}

void SetDistance(const b2DistanceJoint& made, Pin* pin) {
  SetPoints(made, pin);
  TurnsFreely(pin);
  pin->by_distance = true;
  pin->lower = made.GetMinLength();
  pin->upper = made.GetMaxLength() < FLT_MAX ? made.GetMaxLength() : kNoEnd;
}

/// Sets the rest position of a spring of this frequency (Hz). Its damping is ignored.
void SetSpring(b2Joint* made, float frequency, Pin* pin) {
  const float swing = 2 * b2_pi * frequency;
  if (made->GetType() == e_wheelJoint) pin->swing = swing;
  if (made->GetType() == e_distanceJoint) {
    pin->swing = swing;
    pin->rest = static_cast<b2DistanceJoint*>(made)->GetLength();
  }
  if (made->GetType() != e_weldJoint) return;
  pin->turn_swing = swing;
  pin->turn_rest = static_cast<b2WeldJoint*>(made)->GetReferenceAngle();
}

/// False if the joint constrains no geometry.
bool SetHold(b2Joint* made, Pin* pin) {
  switch (made->GetType()) {
    case e_revoluteJoint: SetRevolute(*static_cast<b2RevoluteJoint*>(made), pin); return true;
    case e_weldJoint: SetWeld(*static_cast<b2WeldJoint*>(made), pin); return true;
    case e_wheelJoint:
      SetLine(*static_cast<b2WheelJoint*>(made), pin);
      TurnsFreely(pin);
      return true;
    case e_prismaticJoint: {
      const auto& slide = *static_cast<b2PrismaticJoint*>(made);
      SetLine(slide, pin);
      KeepsAngle(slide.GetReferenceAngle(), pin);
      return true;
    }
    case e_distanceJoint: SetDistance(*static_cast<b2DistanceJoint*>(made), pin); return true;
    default: return false;
  }
}

}  // namespace

std::vector<Pin> World::Pins() const {
  return impl_->all_present ? impl_->all_present->pins : impl_->FindPins();
}

std::vector<Pin> World::Impl::FindPins() const {
  std::vector<Pin> pins;
  for (std::size_t j = 0; j < built.joints.size(); ++j) {
    b2Joint* made = built.joints[j];
    if (made == nullptr) continue;
    Pin pin;
    if (!SetHold(made, &pin)) continue;
    const Joint& joint = scene.joints[j];
    SetSpring(made, joint.frequency_hz, &pin);
    pin.a.body = IndexOf(made->GetBodyA());
    pin.b.body = IndexOf(made->GetBodyB());
    pin.a.assembly = composition.assembly_of_part[static_cast<std::size_t>(joint.a)];
    pin.b.assembly = composition.assembly_of_part[static_cast<std::size_t>(joint.b)];
    pins.push_back(pin);
  }
  return pins;
}

bool World::Joined(int body) const {
  const std::vector<int>& joints = impl_->memory.joints_of[static_cast<std::size_t>(body)];
  return std::any_of(joints.begin(), joints.end(), [this](int joint) {
    return !impl_->scene.joints[static_cast<std::size_t>(joint)].gone;
  });
}

MassPoint World::mass_point(int body) const {
  const b2MassData& mass = impl_->moving(body).mass;
  return {mass.mass, mass.I - mass.mass * b2Dot(mass.center, mass.center), FromB2(mass.center)};
}

BodyState World::ReadAssembly(int assembly) const {
  SEAM_ASSERT(assembly >= 0 && assembly < static_cast<int>(impl_->built.bodies.size()));
  const Assembly& a = composition().assemblies[static_cast<std::size_t>(assembly)];
  if (a.anchored && a.kinematic < 0) {
    const Part& root = scene().parts[static_cast<std::size_t>(a.id)];
    return {root.position, root.angle, {0, 0}, 0};
  }
  const b2Body* b = impl_->built.bodies[static_cast<std::size_t>(assembly)];
  return {FromB2(b->GetPosition()), b->GetAngle(), FromB2(b->GetLinearVelocity()),
          b->GetAngularVelocity()};
}

}  // namespace seam
