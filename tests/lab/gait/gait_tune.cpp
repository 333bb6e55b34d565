#include "tests/lab/gait/gait_tune.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "common/base/check.h"
#include "common/base/process.h"
#include "tests/lab/experiment/jobs.h"
#include "tests/lab/gait/cma_es.h"

namespace seam {
namespace {

/// How much a sample costs for each deviation, squared, that it is beyond its bounds.
constexpr double kBeyond = 0.1;

double MeanCost(const GaitFile& file, const std::string& name, const StartRange& starts,
                const CharacterGains& gains) {
  const Ability& ability = *FindAbility(name);
  const GaitSetup setup{file.solver, file.character};
  double cost = 0;
  for (int i = 0; i < starts.count; ++i) cost += ability.run(setup, gains, starts.from + i).cost;
  return cost / starts.count;
}

/// Of the ability that is searched, and of the others by their weights.
double TrainingCost(const GaitFile& file, const CharacterGains& gains) {
  double cost = MeanCost(file, file.ability, file.train, gains);
  for (const AlsoTrained& also : file.also) {
    cost += also.weight * MeanCost(file, also.ability, also.train, gains);
  }
  return cost;
}

/// `work` for each index as numbers, several at a time. Throws what a job throws.
std::vector<std::string> Results(std::size_t count, int jobs,
                                 const std::function<std::string(std::size_t)>& work) {
  std::vector<std::string> results(count);
  std::string failure;
  RunJobs(
      count, jobs, work,
      [&](std::size_t i, const JobResult& result) {
        results[i] = result.text;
        if (!result.good && failure.empty()) failure = result.text;
      },
      [&] { return g_stop != 0 || !failure.empty(); });
  if (!failure.empty()) throw OperatorError("a trial failed: " + failure);
  return results;
}

/// A sample, in deviations from the start, as gains within their bounds; `beyond`: what is cut off.
CharacterGains GainsOf(const GaitFile& file, const CmaEs::Point& sample, double* beyond) {
  CharacterGains gains = StartGains(file);
  for (std::size_t i = 0; i < file.gains.size(); ++i) {
    const SearchedGain& gain = file.gains[i];
    const double wished = gain.start + gain.sigma * sample[static_cast<Eigen::Index>(i)];
    const double value = std::clamp(wished, gain.min, gain.max);
    const double off = (wished - value) / gain.sigma;
    *beyond += off * off;
    *FindGain(&gains, gain.name) = static_cast<float>(value);
  }
  return gains;
}

}  // namespace

CharacterGains StartGains(const GaitFile& file) {
  CharacterGains gains;
  for (const SearchedGain& gain : file.gains) {
    *FindGain(&gains, gain.name) = static_cast<float>(gain.start);
  }
  return gains;
}

GaitResult TuneGait(const GaitFile& file, int jobs,
                    const std::function<void(const GaitGeneration&)>& done) {
  GaitResult result;
  result.before = result.after = TrainingCost(file, result.gains);
  const auto n = static_cast<Eigen::Index>(file.gains.size());
  CmaEs search(CmaEs::Point::Zero(n), 1, file.lambda, static_cast<std::uint64_t>(file.seed));
  for (int generation = 1; generation <= file.generations; ++generation) {
    std::vector<CmaEs::Point> samples = search.Ask();
    samples.push_back(search.mean());  // often better than the samples around it
    const std::vector<std::string> texts = Results(samples.size(), jobs, [&](std::size_t i) {
      double beyond = 0;
      const CharacterGains gains = GainsOf(file, samples[i], &beyond);
      return fmt::format("{}", TrainingCost(file, gains) + kBeyond * beyond);
    });
    if (g_stop != 0) {
      result.complete = false;
      break;
    }
    std::vector<double> costs;
    for (const std::string& text : texts) costs.push_back(std::stod(text));
    for (std::size_t i = 0; i < costs.size(); ++i) {
      if (costs[i] >= result.after) continue;
      double beyond = 0;
      result.after = costs[i];
      result.gains = GainsOf(file, samples[i], &beyond);
    }
    costs.pop_back();
    search.Tell(costs);
    std::sort(costs.begin(), costs.end());
    done({generation, costs.front(), costs[costs.size() / 2], search.sigma()});
  }
  return result;
}

std::vector<GaitTrial> RunTrials(const GaitFile& file, const CharacterGains& gains,
                                 const StartRange& starts, int jobs) {
  const Ability& ability = *FindAbility(file.ability);
  const GaitSetup setup{file.solver, file.character};
  const auto count = static_cast<std::size_t>(starts.count);
  std::vector<GaitTrial> trials;
  for (const std::string& text : Results(count, jobs, [&](std::size_t i) {
         const GaitTrial t = ability.run(setup, gains, starts.from + static_cast<int>(i));
         return fmt::format("{} {} {} {}", t.cost, t.good ? 1 : 0, t.figure, t.group);
       })) {
    std::istringstream in(text);
    GaitTrial trial;
    in >> trial.cost >> trial.good >> trial.figure >> std::ws;
    std::getline(in, trial.group);
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace seam
