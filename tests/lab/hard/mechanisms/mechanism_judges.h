#pragma once
/// The judges of mechanisms that carry, drive and collide. What each one's error is, is said here
/// once. Whatever a run did that it must not (fell, tore, flew off) is its failure.

#include <memory>

#include "tests/lab/hard/invariant_watch.h"

namespace seam {

/// A part that must have come far by the end: further right, or higher, than this.
struct Journey {
  std::string part;
  Vec2 at_least{0, 0};  ///< m, from where it began; each axis for itself
};

/// Error: the worst joint (JointMeter::Worst), m, beyond what it was at tick 0. Fails with "came
/// apart" above `tear_m`, and with "did not get there" where the journey was not made.
std::unique_ptr<Judge> MakeJointDriftJudge(const WatchLimits& limits, double tear_m,
                                           const Journey& journey, const Scene& scene);

/// Error: the deepest overlap by true shapes, m, from `from_s` on (in a run that ends before: in
/// its last tick).
std::unique_ptr<Judge> MakeOverlapJudge(const WatchLimits& limits, double from_s,
                                        const Scene& scene);

/// Error: the greatest |E / E0 - 1| of the mechanical energy E.
std::unique_ptr<Judge> MakeEnergyJudge(const WatchLimits& limits, const Scene& scene);

/// What is held, by what, and what is done with it.
struct Grip {
  std::string load, jaw;
  double from_s = 0;   ///< the jaws are closed
  double lift_m = 0;   ///< by so much the load is higher at the end, or it "is not up"
  double loose_m = 1;  ///< farther from where the jaw held it, it "slipped out"
};

/// Error: the farthest, m, that the load's position came from where it was in the jaw's frame when
/// the grip was closed.
std::unique_ptr<Judge> MakeGripJudge(const WatchLimits& limits, const Grip& grip,
                                     const Scene& scene);

}  // namespace seam
