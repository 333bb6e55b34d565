#pragma once
/// From where on a person notices what is wrong with a motion. docs/metrics.md has the sources.

#include <cmath>

namespace seam {

/// Share of the velocity by which it may be wrong: over one tick, and over half a second.
constexpr double kVelocityShareTick = 1.0, kVelocityShareLong = 0.07;
constexpr double kVelocityLong = 0.5;  ///< s
/// Of velocities that are wrong by less than this, or for a way of less than this, nobody notices
/// anything: 1 cm is half a pixel where 40 m are 2000 pixels wide. m/s, m
constexpr double kVelocityFloor = 0.1, kWayFloor = 0.01;

constexpr double kContactDelay = 0.1;  ///< s: an effect later than this has another cause
/// A blow changes a velocity by at least this within two ticks, m/s.
constexpr double kBlowMin = 1;

/// A body stands still for so long, s, while the oracle's goes faster than this, m/s.
constexpr double kStopLong = 0.08, kStopTruthMin = 0.5;
/// And "still" is slower than this share of that.
constexpr double kStopShare = 0.1;

/// A bend of the path, rad: between its directions over so long a time before and after it, s, at
/// not less than this speed, m/s.
constexpr double kKink = 12 * 3.14159265358979323846 / 180, kKinkLeg = 0.05, kKinkSpeedMin = 0.5;
/// The oracle's path has its own bends as far from there, s.
constexpr double kKinkReach = 0.1;

/// Of the length of a mechanism's link.
constexpr double kStretch = 0.03;

/// Slower bodies do not move, m/s: seconds in which a body does not move are not counted.
constexpr double kMovesMin = 0.1;

/// The share of the velocity that may be wrong over `tau` s, of ticks of `h` s: on a straight line
/// between the two ends in logarithms of both.
inline double VelocityShare(double tau, double h) {
  if (tau <= h) return kVelocityShareTick;
  const double part = std::log(tau / h) / std::log(kVelocityLong / h);
  return kVelocityShareTick * std::pow(kVelocityShareLong / kVelocityShareTick, part);
}

}  // namespace seam
