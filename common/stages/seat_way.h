#pragma once
/// Progress of a player on the way to a seat; for a peer that missed the start, also an estimate of
/// it.

#include <Eigen/Core>

#include "common/base/geometry.h"
#include "common/scene/scene.h"

namespace seam {

/// Returns the share of the way, 0..1, at this many ticks after the seat was taken: 3x^2 - 2x^3 of
/// its time, so that it begins and ends smoothly.
double ShareOfWay(double ticks, int tick_hz);

struct SeatWay {
  int ticks = -1;   ///< since the seat was taken; -1: no approach
  Transform2 from;  ///< the player's part in the seat's frame, at the start
};

/// Observation of a player on the way.
struct SeatObservation {
  Transform2 place;             ///< the player's part in the seat's frame
  Eigen::Vector2d speed{0, 0};  ///< m/s, of that part there, in that frame, against the seat's
};

/// Corrects `way` from an observation, for a player that set out before this peer joined. A player
/// at rest far from the seat tells little: then `way` stays, as if it began now.
///
/// With the share x of the time T elapsed, on a way of length d, the speed is d 6x(1 - x)/T and the
/// remaining way d (1 - x)^2 (1 + 2x). So speed/remaining T = 6x/((1 - x)(1 + 2x)), with one
/// solution in 0..1.
void EstimateWay(const Seat& seat, const Solver& solver, const SeatObservation& seen, SeatWay* way);

/// Rounds to single precision, so that a pose is the same before and after saving as floats.
Transform2 Rounded(const Transform2& pose);

}  // namespace seam
