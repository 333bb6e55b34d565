#pragma once
/// Force of the water on a turning propeller: blade elements, as flat plates that push the water by
/// its own law of form drag (`drag_normal`). Pure arithmetic in double precision.
///
/// A blade at radius r is pitched by phi, tan phi = P / (2 pi r). At n turns a second, with the
/// disc moving at u through the water along its axis, the plate meets the water at the normal speed
/// w cos phi, w = n P - u. So each metre of the disc in the water gives, along the axis,
///
///     f(r) = rho/2 drag_normal solidity cos^3 phi |w| w
///
/// and the whole disc T = rho/2 drag_normal solidity L |w| w, with L the integral of cos^3 phi over
/// the part in the water. The shaft needs the torque T P / (2 pi): its power, 2 pi n Q = n P T, is
/// at least T u; the rest stays in the water.

#include "common/scene/forces.h"

namespace seam {

/// Returns the integral of cos^3 phi over the disc from `from` to `to`, m from its middle, of
/// either sign; `from` <= `to`.
double EffectiveSpan(double pitch, double from, double to);

/// Returns the thrust along the axis, N. `span`: EffectiveSpan of the part in the water, m; `drag`:
/// rho/2 times the water's drag_normal, kg/m^2; `turns`: 1/s; `speed`: u, m/s. Limited by the
/// propeller's torque.
double PropellerThrust(const Screw& screw, double span, double drag, double turns,
                       double speed);

}  // namespace seam
