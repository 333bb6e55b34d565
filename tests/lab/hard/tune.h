#pragma once
/// Searches for the cheapest solver setting whose error is below a limit.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/physics/scene.h"

namespace seam {

/// What a setting gave.
struct Trial {
  Solver solver;
  double predicted = 0;               ///< cost, in the unit of the problem's `predicted`
  double error = 0;                   ///< infinite: it diverged
  std::string failure;                ///< what happened that must not: it does not pass then
  std::optional<double> cost;         ///< measured, where it mattered
};

struct TuneProblem {
  /// Fills in error and failure. Asked once for a setting.
  std::function<void(Trial*)> run;
  std::function<double(const Solver&)> predicted;
  /// Asked for what passes and is not much dearer than the best, and for the front.
  std::function<double(const Solver&)> measured_cost;
  Solver own;                         ///< what is not searched is as here
  double limit = 0;                   ///< of the error
  bool keep_hz = false;               ///< tick_hz is as in `own`
  double budget = 0;                  ///< most predicted cost to spend on runs
};

struct TuneResult {
  std::vector<Trial> trials;          ///< in the order in which they were run
  std::vector<std::size_t> front;     ///< trials that no other beats in both; cheapest first
  std::optional<std::size_t> best;    ///< the cheapest that passes
  bool complete = true;               ///< false: the budget ended the search
};

/// Runs a coarse grid (30 to 240 Hz, 1 to 8 substeps, 1/1 to 16/4, both skins) by rising predicted
/// cost until one passes, and on to 1.3 times its cost; then takes from all that pass what can be
/// taken, one lever at a time. Among those within 1.5 times the least predicted cost the measured
/// cost decides, and of those within 5 % of the least measured cost the least predicted.
TuneResult Tune(const TuneProblem& problem);

}  // namespace seam
