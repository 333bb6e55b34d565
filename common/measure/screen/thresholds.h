#pragma once
/// Thresholds from which a person notices an error of motion. docs/metrics.md has the sources.

#include <cmath>

#include "common/base/geometry.h"

namespace seam {

/// Tolerated velocity error as a share of the velocity: over one tick, and over kVelocityLong.
constexpr double kVelocityShareTick = 1.0, kVelocityShareLong = 0.07;
constexpr double kVelocityLong = 0.5;  ///< s
/// Velocity error, m/s, and displacement error, m, below which nobody notices anything: 1 cm is
/// half a pixel where 40 m are 2000 pixels wide.
constexpr double kVelocityFloor = 0.1, kWayFloor = 0.01;

constexpr double kContactDelay = 0.1;  ///< s: a later effect looks as if it had another cause
/// Least change of velocity by an impact within two ticks, m/s.
constexpr double kBlowMin = 1;

/// Least duration of a noticed stop, s, and least speed of the oracle's body meanwhile, m/s.
constexpr double kStopLong = 0.08, kStopTruthMin = 0.5;
/// A body stands still below this share of the oracle's speed.
constexpr double kStopShare = 0.1;

/// Least noticed bend of the path, rad; duration of the legs before and after it over which the
/// directions are taken, s; least speed on both legs, m/s.
constexpr double kKink = 12 * kPi / 180, kKinkLeg = 0.05, kKinkSpeedMin = 0.5;
/// Bends of the oracle's path within this time of a bend excuse it, s.
constexpr double kKinkReach = 0.1;

/// Least noticed stretch, as a share of the length of a mechanism's link.
constexpr double kStretch = 0.03;

/// Least noticed overlap of two bodies beyond the oracle's, m, and its least duration, s.
constexpr double kOverlapFloor = 0.05, kOverlapLong = 0.08;

/// Least speed of a moving body, m/s. Seconds in which a body does not move are not counted.
constexpr double kMovesMin = 0.1;

/// Returns the tolerated share of velocity error over `tau` s, for ticks of `h` s: interpolated
/// linearly between the two ends in logarithms of time and share.
inline double VelocityShare(double tau, double h) {
  if (tau <= h) return kVelocityShareTick;
  const double part = std::log(tau / h) / std::log(kVelocityLong / h);
  return kVelocityShareTick * std::pow(kVelocityShareLong / kVelocityShareTick, part);
}

}  // namespace seam
