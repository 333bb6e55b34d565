#pragma once
/// The way to a seat: how much of it is behind somebody when, and, for who has not seen it begin,
/// where it began.

#include <Eigen/Core>

#include "common/base/geometry.h"
#include "common/scene/scene.h"

namespace seam {

/// Share of the way, 0..1, so many ticks after the seat was taken: 3x^2 - 2x^3 of its time, so that
/// it begins and ends without a jerk.
double ShareOfWay(double ticks, int tick_hz);

struct SeatWay {
  int ticks = -1;   ///< since the seat was taken; -1: nobody is on the way
  Transform2 from;  ///< the player's part in the seat's frame, when it set out
};

/// What is seen of somebody who is on the way.
struct SeatSight {
  Transform2 place;             ///< the player's part in the seat's frame
  Eigen::Vector2d speed{0, 0};  ///< m/s, of that part there, in that frame, against the seat's
};

/// Puts `way` right by what is seen, for somebody who was on the way before this peer came. It says
/// little of who stands still far from the seat: then `way` stays, and goes on as if it began now.
///
/// With x of the time T behind it, of a way of length d, its speed is d 6x(1 - x)/T, and d (1 -
/// x)^2 (1 + 2x) is left. So speed/left T = 6x/((1 - x)(1 + 2x)), which has one solution in 0..1.
void FindWay(const Seat& seat, const Solver& solver, const SeatSight& seen, SeatWay* way);

/// As floats have it: what is remembered as floats is the same with and without a way back.
Transform2 Rounded(const Transform2& pose);

}  // namespace seam
