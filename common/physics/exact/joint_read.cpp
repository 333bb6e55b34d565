/// Reads the engine's joints and their impulses.

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/physics/exact/gear_rows.h"
#include "common/physics/exact/joint_rows.h"

namespace seam {
namespace {

/// Share of its bound from which a motor counts as at it.
constexpr double kNearly = 1 - 1e-6;
/// A limit is near within this distance plus twice the motion of a step, rad and m.
constexpr double kNearAngle = 0.1, kNearLength = 0.1;

template <typename Made>
void ReadAnchors(const Made& made, ExactJoint* out) {
  out->anchor_a = made.GetLocalAnchorA();
  out->anchor_b = made.GetLocalAnchorB();
}

template <typename Made>
void ReadSlide(const Made& made, ExactJoint* out) {
  ReadAnchors(made, out);
  out->axis = made.GetLocalAxisA();
  out->limited = made.IsLimitEnabled();
  out->lower = static_cast<double>(made.GetLowerLimit());
  out->upper = static_cast<double>(made.GetUpperLimit());
}

template <typename Made>
void ReadMotor(const Made& made, float most, ExactJoint* joint) {
  joint->drives = made.IsMotorEnabled();
  joint->speed = static_cast<double>(made.GetMotorSpeed());
  joint->most = static_cast<double>(most);
}

bool HasLower(const ExactJoint& joint) { return joint.lower > 0; }
bool HasUpper(const ExactJoint& joint) { return joint.upper < 1e9; }

}  // namespace

ExactJoint ReadJoint(b2Joint* made) {
  ExactJoint out;
  out.made = made;
  out.type = made->GetType();
  out.impulses = ImpulsesOf(made);
  switch (out.type) {
    case e_revoluteJoint: {
      const auto& j = As<b2RevoluteJoint>(out);
      ReadAnchors(j, &out);
      out.reference = static_cast<double>(j.GetReferenceAngle());
      out.limited = j.IsLimitEnabled();
      out.lower = static_cast<double>(j.GetLowerLimit());
      out.upper = static_cast<double>(j.GetUpperLimit());
      break;
    }
    case e_weldJoint: {
      const auto& j = As<b2WeldJoint>(out);
      ReadAnchors(j, &out);
      out.reference = static_cast<double>(j.GetReferenceAngle());
      out.stiffness = static_cast<double>(j.GetStiffness());
      out.damping = static_cast<double>(j.GetDamping());
      break;
    }
    case e_prismaticJoint: {
      const auto& j = As<b2PrismaticJoint>(out);
      ReadSlide(j, &out);
      out.reference = static_cast<double>(j.GetReferenceAngle());
      break;
    }
    case e_wheelJoint: {
      const auto& j = As<b2WheelJoint>(out);
      ReadSlide(j, &out);
      out.stiffness = static_cast<double>(j.GetStiffness());
      out.damping = static_cast<double>(j.GetDamping());
      break;
    }
    case e_distanceJoint: {
      const auto& j = As<b2DistanceJoint>(out);
      ReadAnchors(j, &out);
      out.lower = static_cast<double>(j.GetMinLength());
      out.upper = static_cast<double>(j.GetMaxLength());
      out.reference = static_cast<double>(j.GetLength());
      out.stiffness = static_cast<double>(j.GetStiffness());
      out.damping = static_cast<double>(j.GetDamping());
      if (IsRod(out)) out.lower = out.reference;
      break;
    }
    case e_pulleyJoint: {
      auto& j = *static_cast<b2PulleyJoint*>(made);
      out.anchor_a = made->GetBodyA()->GetLocalPoint(j.GetAnchorA());
      out.anchor_b = made->GetBodyB()->GetLocalPoint(j.GetAnchorB());
      out.ground_a = j.GetGroundAnchorA();
      out.ground_b = j.GetGroundAnchorB();
      out.ratio = static_cast<double>(j.GetRatio());
      out.length =
          static_cast<double>(j.GetLengthA()) + out.ratio * static_cast<double>(j.GetLengthB());
      break;
    }
    case e_gearJoint: out.gear = ReadGear(static_cast<b2GearJoint*>(made)); break;
    case e_motorJoint: break;  // acts between the bodies' origins
    default: SEAM_ASSERT(false);
  }
  return out;
}

void LookAt(double h, ExactJoint* joint) {
  double at = 0, speed = 0, margin = kNearLength;
  switch (joint->type) {
    case e_revoluteJoint: {
      const auto& made = As<b2RevoluteJoint>(*joint);
      ReadMotor(made, made.GetMaxMotorTorque(), joint);
      if (!joint->limited) return;
      at = static_cast<double>(made.GetJointAngle());
      speed = static_cast<double>(made.GetJointSpeed());
      margin = kNearAngle;
      break;
    }
    case e_prismaticJoint: {
      const auto& made = As<b2PrismaticJoint>(*joint);
      ReadMotor(made, made.GetMaxMotorForce(), joint);
      if (!joint->limited) return;
      at = static_cast<double>(made.GetJointTranslation());
      speed = static_cast<double>(made.GetJointSpeed());
      break;
    }
    case e_wheelJoint: {
      const auto& made = As<b2WheelJoint>(*joint);
      ReadMotor(made, made.GetMaxMotorTorque(), joint);
      if (!joint->limited) return;
      at = static_cast<double>(made.GetJointTranslation());
      speed = static_cast<double>(made.GetJointLinearSpeed());
      break;
    }
    case e_distanceJoint: {
      if (IsRod(*joint)) return;
      const b2Body* a = joint->made->GetBodyA();
      const b2Body* b = joint->made->GetBodyB();
      const b2Vec2 way = b->GetWorldPoint(joint->anchor_b) - a->GetWorldPoint(joint->anchor_a);
      const b2Vec2 motion = b->GetLinearVelocityFromLocalPoint(joint->anchor_b) -
                            a->GetLinearVelocityFromLocalPoint(joint->anchor_a);
      at = static_cast<double>(way.Length());
      speed = static_cast<double>(motion.Length());
      joint->near_lower = HasLower(*joint);
      joint->near_upper = HasUpper(*joint);
      break;
    }
    case e_pulleyJoint: {
      const auto near_stop = [&](const b2Body* body, b2Vec2 anchor, b2Vec2 ground) {
        const double way = static_cast<double>((body->GetWorldPoint(anchor) - ground).Length());
        const double fast =
            static_cast<double>(body->GetLinearVelocityFromLocalPoint(anchor).Length());
        return way - kPulleyStop < margin + 2 * h * fast;
      };
      joint->near_lower = near_stop(joint->made->GetBodyA(), joint->anchor_a, joint->ground_a);
      joint->near_upper = near_stop(joint->made->GetBodyB(), joint->anchor_b, joint->ground_b);
      return;
    }
    default: return;
  }
  const double reach = margin + 2 * h * std::fabs(speed);
  const bool both = joint->type != e_distanceJoint;
  joint->near_lower = (both || joint->near_lower) && at - joint->lower < reach;
  joint->near_upper = (both || joint->near_upper) && joint->upper - at < reach;
}

/// Marks a row without a stored impulse: the engine's joint has none for it.
constexpr int kNotKept = -1;

/// Finds the index of each row's impulse in the joint, in the rows' order. Returns their number.
static int KeptAt(const ExactJoint& joint, int* kept) {
  int count = 0;
  const auto range = [&](int lower) {
    if (!joint.limited) return;
    if (joint.lower >= joint.upper || joint.near_lower) kept[count++] = lower;
    if (joint.lower < joint.upper && joint.near_upper) kept[count++] = lower + 1;
  };
  switch (joint.type) {
    case e_revoluteJoint:
    case e_prismaticJoint:
      kept[count++] = 0;
      kept[count++] = 1;
      if (joint.drives) kept[count++] = 2;
      range(3);
      break;
    case e_wheelJoint:
      kept[count++] = 0;
      if (joint.stiffness > 0) kept[count++] = 2;
      if (joint.drives) kept[count++] = 1;
      range(3);
      break;
    case e_pulleyJoint:
      kept[count++] = 0;
      if (joint.near_lower) kept[count++] = kNotKept;
      if (joint.near_upper) kept[count++] = kNotKept;
      break;
    case e_gearJoint: kept[count++] = 0; break;
    case e_distanceJoint:
      if (IsRod(joint) || joint.stiffness > 0) kept[count++] = 0;
      if (!IsRod(joint) && joint.near_lower) kept[count++] = 1;
      if (!IsRod(joint) && joint.near_upper) kept[count++] = 2;
      break;
    default:
      for (int i = 0; i < 3; ++i) kept[count++] = i;
  }
  return count;
}

int RowCount(const ExactJoint& joint) {
  int kept[kJointRowsMost];
  return KeptAt(joint, kept);
}

void LoadImpulses(const ExactJoint& joint, double share, Row* rows) {
  int kept[kJointRowsMost];
  const int count = KeptAt(joint, kept);
  for (int i = 0; i < count; ++i) {
    Row& row = rows[i];
    const double impulse =
        kept[i] == kNotKept ? 0 : share * static_cast<double>(*joint.impulses.at[kept[i]]);
    row.base = row.warm = impulse;
    row.state = RowState::kFree;
    if (row.kind == RowKind::kLimit && impulse <= 0) row.state = RowState::kLow;
    if (row.kind == RowKind::kMotor && impulse <= -row.most * kNearly) row.state = RowState::kLow;
    if (row.kind == RowKind::kMotor && impulse >= row.most * kNearly) row.state = RowState::kHigh;
  }
}

void StoreImpulses(const ExactJoint& joint, const Row* rows) {
  for (float* impulse : JointImpulses(joint.impulses)) *impulse = 0;
  int kept[kJointRowsMost];
  const int count = KeptAt(joint, kept);
  for (int i = 0; i < count; ++i) {
    if (kept[i] != kNotKept) *joint.impulses.at[kept[i]] = static_cast<float>(rows[i].total);
  }
}

}  // namespace seam
