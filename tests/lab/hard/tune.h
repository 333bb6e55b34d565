#pragma once
/// Searches for the cheapest solver setting whose error is below a limit.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

/// Result of a setting.
struct Trial {
  Solver solver;
  double predicted = 0;        ///< cost, in the unit of the problem's `predicted`
  double error = 0;            ///< infinite: it diverged
  std::string failure;         ///< the violation, with which it does not pass; empty: none
  double run_cost = 0;         ///< cost of its run, in any unit: a first idea of its cost
  std::optional<double> cost;  ///< measured, where it mattered
};

struct TuneProblem {
  /// Fills in error, failure and run_cost. Asked once for a setting.
  std::function<void(Trial*)> run;
  std::function<double(const Solver&)> predicted;
  /// Asked for the cheapest that pass and for the front.
  std::function<double(const Solver&)> measured_cost;
  Solver own;            ///< tried too; settings that are not searched are as here
  double limit = 0;      ///< of the error
  bool keep_hz = false;  ///< tick_hz is as in `own`
  /// The scene has joints: exact ones are tried with 1, 2 and 4 substeps of their own, and the grid
  /// has iterative ones.
  bool jointed = false;
  double budget = 0;  ///< most predicted cost to spend on runs
};

struct TuneResult {
  std::vector<Trial> trials;        ///< in the order in which they were run
  std::vector<std::size_t> front;   ///< trials that no other beats in both; cheapest first
  std::optional<std::size_t> best;  ///< the cheapest that passes
  bool complete = true;             ///< false: the budget ended the search
};

/// Runs a coarse grid (30 to 240 Hz, 1 to 8 substeps, 1/1 to 16/4, both skins) by rising predicted
/// cost until one passes, and on to twice its cost; takes from all that pass what can be taken, one
/// lever at a time; and tries the neighbours, also the dearer ones, of the three whose runs took
/// least: what is solved better sleeps sooner, which no prediction knows. Of the dozen that pass
/// and took least, and of the three least predicted, the measured cost decides; of what is within
/// 5 % in either of two timings, the prediction.
TuneResult Tune(const TuneProblem& problem);

}  // namespace seam
