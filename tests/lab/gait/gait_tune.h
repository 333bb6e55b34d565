#pragma once
/// The search of `tune gait` as a function: which gains make an ability's trials cheap.

#include <functional>
#include <vector>

#include "tests/lab/gait/ability.h"
#include "tests/lab/gait/gait_file.h"

namespace seam {

/// One generation, when it is done.
struct GaitGeneration {
  int number = 0;
  double best = 0, median = 0;  ///< mean costs on the training starts, of its samples
  double sigma = 0;
};

struct GaitResult {
  CharacterGains gains;          ///< the cheapest that were tried, those built in included
  double before = 0, after = 0;  ///< mean costs on the training starts
  bool complete = true;          ///< false: stopped by a signal
};

/// The gains built in, with the file's starting values.
CharacterGains StartGains(const GaitFile& file);

/// Deterministic: the file decides, whatever `jobs` is. Runs processes: requires a program of one
/// thread. Throws OperatorError when a trial crashes.
GaitResult TuneGait(const GaitFile& file, int jobs,
                    const std::function<void(const GaitGeneration&)>& done);

/// The trials of a range of starts, in their order.
std::vector<GaitTrial> RunTrials(const GaitFile& file, const CharacterGains& gains,
                                 const StartRange& starts, int jobs);

}  // namespace seam
