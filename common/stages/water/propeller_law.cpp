#include "common/stages/water/propeller_law.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"

namespace seam {
namespace {

/// Returns the integral of cos^3 phi = r^3 / (r^2 + a^2)^(3/2) from 0 to `r`, odd in r.
double SpanTo(double a, double r) {
  const double root = std::sqrt(r * r + a * a);
  const double span = (r * r + 2 * a * a) / root - 2 * a;
  return r < 0 ? -span : span;
}

}  // namespace

double EffectiveSpan(double pitch, double from, double to) {
  const double a = pitch / (2 * static_cast<double>(kPi));
  return SpanTo(a, to) - SpanTo(a, from);
}

double PropellerThrust(const Screw& screw, double span, double drag, double turns, double speed) {
  const auto pitch = static_cast<double>(screw.pitch);
  const double slip = turns * pitch - speed;
  const double thrust = drag * static_cast<double>(screw.solidity) * span * std::fabs(slip) * slip;
  if (screw.torque <= 0) return thrust;
  const double most = static_cast<double>(screw.torque) * 2 * static_cast<double>(kPi) / pitch;
  return std::clamp(thrust, -most, most);
}

}  // namespace seam
