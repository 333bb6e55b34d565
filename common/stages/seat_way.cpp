#include "common/stages/seat_way.h"

#include <algorithm>
#include <cmath>

#include "common/stages/make_stages.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Remaining way, m, at which a player has arrived; and at which a player that comes no nearer has:
/// the heard states of a vehicle and of its player are not of the same tick.
constexpr double kThere = 0.03, kArrivedAtRest = 0.5;
/// speed/remaining T below which a player may not have set out: it is larger from 3 ticks on.
constexpr double kSetOutMin = 0.5;
/// Share up to which the way is estimated again, and x up to which an estimate counts: beyond it,
/// too little of the way is left to tell.
constexpr double kEstimatedUpTo = 0.9, kFoundUpTo = 0.94;
/// rad: a way turns by less than half a turn.
constexpr double kWayTurnMax = 3.1;

}  // namespace

double ShareOfWay(double ticks, int tick_hz) {
  const int wait = SeatWaitTicks(tick_hz), all = SeatTicks(tick_hz);
  const double x = std::clamp((ticks - wait) / (all - wait), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

Transform2 Rounded(const Transform2& pose) {
  return {pose.shift.cast<float>().cast<double>(),
          static_cast<double>(static_cast<float>(pose.angle))};
}

void EstimateWay(const Seat& seat, const Solver& solver, const SeatObservation& seen,
                 SeatWay* way) {
  const int wait = SeatWaitTicks(solver.tick_hz), all = SeatTicks(solver.tick_hz);
  const Vector2d at = seat.at.cast<double>(), left = at - seen.place.shift;
  const double metres = left.norm(), far = std::max(metres, kThere);
  const double k = seen.speed.dot(left) / (far * far) * (all - wait) / solver.tick_hz;
  if (metres < kThere || (metres < kArrivedAtRest && k < kSetOutMin)) {
    *way = {std::max(way->ticks, all), Rounded(seen.place)};
    return;
  }
  if (k < kSetOutMin) return;
  const double x = (k - 6 + std::sqrt((6 - k) * (6 - k) + 8 * k * k)) / (4 * k);
  // The speed is that at the middle of the last step.
  const double ticks = x * (all - wait) + 0.5 / solver.substeps, most = kFoundUpTo * (all - wait);
  const int found = wait + std::max(1, static_cast<int>(std::lround(std::min(ticks, most))));
  const double share = ShareOfWay(found, solver.tick_hz);
  if (share > kEstimatedUpTo && way->ticks > wait) return;
  const double rest = 1 - share, angle = static_cast<double>(seat.angle);
  const double turn = WrapAngle(angle - seen.place.angle) / rest;
  *way = {found, Rounded({at - left / rest, angle - std::clamp(turn, -kWayTurnMax, kWayTurnMax)})};
}

}  // namespace seam
