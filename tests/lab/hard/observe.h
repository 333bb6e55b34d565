#pragma once
/// Runs a hard case once and observes it; compares the cost of its steps with another scene's.

#include <limits>
#include <optional>

#include "tests/lab/hard/hard_case.h"
#include "tests/lab/hard/trajectory.h"

namespace seam {

/// A body beyond this coordinate is lost: the run diverged. m
constexpr double kLostBeyond = 1e6;

/// Observations of a run. Sampled 30 times a second (10 if more than 300 bodies move; else the
/// nearest rate that ticks fall on).
struct Observation {
  double error = 0;          ///< the case's; infinite: it diverged
  std::string failure;       ///< the violation; empty: none
  double penetration_m = 0;  ///< deepest overlap, beyond that at the start
  double joint_drift_m = 0;  ///< worst separation at a joint, beyond that at the start
  /// Greatest rise of the mechanical energy above its start, in units of EnergyScale; empty where
  /// motors or players feed the scene.
  std::optional<double> energy_gain;
  double jitter_mps = 0;           ///< RMS speed of all bodies in the last 5 s; of what rests
  std::optional<double> asleep_s;  ///< when all slept for the first time; empty: never
  double cpu_us_per_s = 0;         ///< of World::Step alone, per simulated second, for a first
                                   ///< idea: CompareCost measures
  double seconds = 0;              ///< simulated: fewer than asked for when it diverged
  bool diverged = false;           ///< a body was lost or is not a number; stopped there
};

/// Unit for gains of energy, J: the kinetic energy at the start, plus the energy that all moving
/// bodies would gain by falling 1 m (or, without gravity and motion, have at 1 m/s).
double EnergyScale(const Scene& scene);

/// Runs `scene` (the case's, with any solver) for `seconds`. `reference`: needed where the case has
/// no judge; the error is then the distance from it. The scripts of the scene's players are played.
Observation Observe(const HardCase& hard, const Scene& scene, double seconds,
                    const Trajectory* reference = nullptr);

/// The scene's own run at 32 times the stock rate (60 Hz, 32 substeps of 8/3, else as the scene
/// says), and by how much that at 16 times differs from it: the estimate of its own error.
struct Reference {
  Trajectory finest;
  double change_m = 0;  ///< RMS, as Distance
  /// The error of the stock setting against it, m: the size of what it is to judge.
  double stock_m = std::numeric_limits<double>::infinity();

  /// True if its own error is small enough to judge by it: at most a quarter of stock's, or 1e-5 m,
  /// where single precision ends.
  bool converged() const;
};
Reference MakeReference(const Scene& scene, double seconds);

/// The path of one run. `nudged`: this body begins 1e-6 m beside its place (or at the next float).
Trajectory PathOf(const Scene& scene, double seconds, int nudged = -1);

/// Cost of World::Step, CPU us per simulated second, for two scenes stepped side by side: a quarter
/// of a second in turn, in this process.
struct Cost {
  double us_per_s = 0, stock_us_per_s = 0;
  double ratio = 0;
};

/// Medians of 15 runs of both over `seconds`; of fewer, but one, when they take more than 0.15 s of
/// CPU time together.
Cost CompareCost(const Scene& scene, const Scene& stock, double seconds);

}  // namespace seam
