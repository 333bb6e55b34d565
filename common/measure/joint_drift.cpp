#include "common/measure/joint_drift.h"

#include <algorithm>
#include <limits>

namespace seam {
namespace {

double Drift(const JointEnds& joint, const std::vector<BodyState>& moving) {
  const Eigen::Vector2d apart = joint.b.PointNow(moving) - joint.a.PointNow(moving);
  switch (joint.kind) {
    case JointKind::kGlue:
    case JointKind::kWeld:
    case JointKind::kRevolute: return apart.norm();
    case JointKind::kWheel: {
      if (joint.frequency_hz <= 0) return apart.norm();
      const Eigen::Vector2d axis = joint.a.AxisNow(moving);
      return std::abs(axis.x() * apart.y() - axis.y() * apart.x());
    }
    case JointKind::kDistance: break;
  }
  return joint.frequency_hz > 0 ? 0 : std::abs(apart.norm() - joint.length);
}

}  // namespace

double JointMeter::Worst(const std::vector<BodyState>& moving) const {
  if (!std::all_of(moving.begin(), moving.end(), IsFinite)) {
    return std::numeric_limits<double>::infinity();
  }
  double worst = 0;
  for (const JointEnds& joint : joints_) worst = std::max(worst, Drift(joint, moving));
  return worst;
}

}  // namespace seam
