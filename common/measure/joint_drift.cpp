#include "common/measure/joint_drift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/scene/joint_kinds.h"

namespace seam {
namespace {

/// Returns the distance of a value from the interval of its limits.
double Beyond(double value, double lower, double upper) {
  return std::max({0.0, lower - value, value - upper});
}

/// Returns the drift of an axis joint: off the axis, and along it beyond the allowed range.
double AlongAxis(const JointEnds& joint, const Eigen::Vector2d& apart,
                 const Eigen::Vector2d& axis) {
  const double off = std::abs(axis.x() * apart.y() - axis.y() * apart.x());
  const bool free = HoldOf(joint.kind) == JointHold::kAxis || joint.frequency_hz > 0;
  if (free && !joint.limited) return off;
  const double along = axis.dot(apart);
  return std::hypot(off, joint.limited ? Beyond(along, joint.lower, joint.upper) : along);
}

/// Returns the rotation of a hinge, rad, or the slide of a prismatic joint, m, since the start.
double Moved(const JointEnds& joint, const std::vector<BodyState>& states) {
  if (HoldOf(joint.kind) == JointHold::kAxis) {
    return joint.a.AxisNow(states).dot(joint.b.PointNow(states) - joint.a.PointNow(states));
  }
  const auto angle = [&](const JointEnd& end) {
    return end.moving < 0 ? 0.0 : double{states[static_cast<std::size_t>(end.moving)].angle};
  };
  return angle(joint.b) - angle(joint.a) - (joint.angle - joint.turn);
}

double Drift(const JointEnds& joint, const std::vector<JointEnds>& all,
             const std::vector<BodyState>& states) {
  const Eigen::Vector2d apart = joint.b.PointNow(states) - joint.a.PointNow(states);
  switch (joint.kind) {
    case JointKind::kGlue:
    case JointKind::kWeld:
    case JointKind::kRevolute: return apart.norm();
    case JointKind::kWheel:
    case JointKind::kPrismatic: return AlongAxis(joint, apart, joint.a.AxisNow(states));
    case JointKind::kRope: return std::max(0.0, apart.norm() - joint.length);
    case JointKind::kDistance:
      if (joint.limited) return Beyond(apart.norm(), joint.lower, joint.upper);
      return joint.frequency_hz > 0 ? 0 : std::abs(apart.norm() - joint.length);
    case JointKind::kGear:
      return std::abs(Moved(all[joint.coupled[0]], states) +
                      joint.ratio * Moved(all[joint.coupled[1]], states));
    case JointKind::kPulley:
      return std::abs((joint.a.PointNow(states) - joint.ground_a).norm() +
                      joint.ratio * (joint.b.PointNow(states) - joint.ground_b).norm() -
                      joint.length);
    case JointKind::kMotor:
    case JointKind::kKinematic: break;
  }
  return 0;
}

}  // namespace

std::vector<double> JointMeter::Drifts(const std::vector<BodyState>& moving,
                                       std::int64_t tick) const {
  if (!std::all_of(moving.begin(), moving.end(), IsFinite)) {
    return std::vector<double>(joints_.size(), std::numeric_limits<double>::infinity());
  }
  std::vector<double> drifts;
  const std::vector<BodyState> all =
      imposed_.count() > 0 ? AllStates(moving, imposed_, tick) : std::vector<BodyState>();
  const std::vector<BodyState>& states = imposed_.count() > 0 ? all : moving;
  for (const JointEnds& joint : joints_) drifts.push_back(Drift(joint, joints_, states));
  return drifts;
}

double JointMeter::Worst(const std::vector<BodyState>& moving, std::int64_t tick) const {
  if (!std::all_of(moving.begin(), moving.end(), IsFinite)) {
    return std::numeric_limits<double>::infinity();
  }
  double worst = 0;
  for (const double drift : Drifts(moving, tick)) worst = std::max(worst, drift);
  return worst;
}

}  // namespace seam
