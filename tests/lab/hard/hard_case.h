#pragma once
/// A hard case for the solver: a scene of scenes/hard, its duration, and its judge.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/physics/world.h"

namespace seam {

/// Three kinds of error that must not be mixed up.
enum class Truth {
  kFormula,    ///< against an exact answer
  kConverged,  ///< against the scene's own run at 32 times the rate
  kInvariant,  ///< against a condition that must never be violated
};

/// Watches one run of one world.
class Judge {
 public:
  virtual ~Judge() = default;
  /// Called once before the first step and then after every tick.
  virtual void See(const World& world) = 0;
  /// >= 0, in the case's unit; infinite or NaN: it diverged. Asked for after the last tick.
  virtual double Error() const = 0;
  /// Returns the failure in a few words, "fell at 12.3 s"; empty: none.
  virtual std::string Failure() const { return ""; }
};

struct HardCase {
  std::string name;   ///< unique; letters, digits, '-'
  std::string scene;  ///< file of scenes/hard, without folder and ".toml"; or a path with ".toml"
  Truth truth = Truth::kInvariant;
  std::string unit;     ///< of the error: "m", "rad", "J/J", "1"
  std::string about;    ///< what the error is, with the source of a formula; a line
  double seconds = 60;  ///< simulated
  /// Makes the judge; empty for kConverged: RMS distance of all bodies from the converged run, m.
  std::function<std::unique_ptr<Judge>(const Scene&)> judge;
  /// Changes the scene after it was read, for families (the same pyramid farther from the origin);
  /// empty: nothing.
  std::function<void(Scene*)> adjust;
  /// Where it has joints, they are tried exactly at these numbers of `joint_substeps`.
  std::vector<int> exact_substeps = {1, 2};
};

/// All cases, those with exact or converged answers first, names ascending within either.
const std::vector<HardCase>& HardCases();

/// exact_*.cpp and invariant_*.cpp.
std::vector<HardCase> ExactCases();
std::vector<HardCase> InvariantCases();
/// mechanisms/: of both kinds.
std::vector<HardCase> MechanismCases();

/// The case's scene as its file has it, adjusted. `folder`: of scenes without a path.
/// Throws OperatorError.
Scene LoadHardScene(const HardCase& hard, const std::string& folder = "scenes/hard");

/// What everybody else uses: 60 Hz, one substep, 8/3 iterations, the engine's own skin, warm
/// starting, continuous collision, sleep, welds as joints, and these solved one after the other.
Solver StockSolver();

}  // namespace seam
