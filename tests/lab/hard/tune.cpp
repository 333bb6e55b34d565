#include "tests/lab/hard/tune.h"

#include <algorithm>
#include <limits>
#include <map>

#include "tests/lab/hard/settings.h"

namespace seam {
namespace {

/// How far behind the first that passes the coarse grid is searched: the prediction may err.
constexpr double kBeyondFirst = 1.3;
/// Whose cost is measured, in units of the least predicted cost that passes.
constexpr double kWorthMeasuring = 1.5;
constexpr std::size_t kMeasuredMost = 12;
/// What two timings of one setting may differ by.
constexpr double kSameCost = 1.05;
constexpr float kSmallSkin = 0.0025f;   // m

class Search {
 public:
  explicit Search(const TuneProblem& problem) : problem_(problem) {}

  TuneResult Run() {
    Coarse();
    Refine();
    MeasureCosts();
    FindFront();
    return std::move(result_);
  }

 private:
  bool Passes(const Trial& trial) const {
    return trial.error <= problem_.limit && trial.failure.empty();
  }

  /// Index of the setting's trial, run now if it was not before; nothing when the budget is spent.
  std::optional<std::size_t> Try(const Solver& solver) {
    const auto [known, fresh] = known_.emplace(SolverLines(solver), result_.trials.size());
    if (!fresh) return known->second;
    Trial trial{solver, problem_.predicted(solver), 0, "", {}};
    if (spent_ + trial.predicted > problem_.budget) {
      known_.erase(known);
      result_.complete = false;
      return std::nullopt;
    }
    spent_ += trial.predicted;
    problem_.run(&trial);
    result_.trials.push_back(trial);
    return known->second;
  }

  std::vector<Solver> Grid() const {
    std::vector<Solver> grid = {problem_.own};
    std::vector<int> rates = {30, 60, 120, 240};
    if (problem_.keep_hz) rates = {problem_.own.tick_hz};
    const std::vector<std::pair<int, int>> iterations = {{1, 1}, {2, 1}, {4, 1}, {8, 3}, {16, 4}};
    for (const float skin : {0.0f, kSmallSkin}) {
      for (const int hz : rates) {
        for (const int substeps : {1, 2, 3, 4, 6, 8}) {
          for (const auto& [velocity, position] : iterations) {
            Solver s = problem_.own;
            s.tick_hz = hz;
            s.substeps = substeps;
            s.velocity_iterations = velocity;
            s.position_iterations = position;
            s.skin = skin;
            grid.push_back(s);
          }
        }
      }
    }
    std::stable_sort(grid.begin(), grid.end(), [this](const Solver& a, const Solver& b) {
      return problem_.predicted(a) < problem_.predicted(b);
    });
    return grid;
  }

  void Coarse() {
    double until = std::numeric_limits<double>::infinity();
    for (const Solver& solver : Grid()) {
      if (problem_.predicted(solver) > until) return;
      const std::optional<std::size_t> at = Try(solver);
      if (!at) return;
      const Trial& trial = result_.trials[*at];
      if (Passes(trial)) until = std::min(until, kBeyondFirst * trial.predicted);
    }
  }

  /// `solver` with a little less of one thing.
  static std::vector<Solver> Lesser(const Solver& solver) {
    std::vector<Solver> lesser;
    for (int Solver::* lever :
         {&Solver::substeps, &Solver::velocity_iterations, &Solver::position_iterations}) {
      Solver less = solver;
      less.*lever -= 1;
      if (less.*lever >= 1) lesser.push_back(less);
    }
    return lesser;
  }

  void Refine() {
    // What is found here is appended and refined in turn: it ends, for each is less than another.
    for (std::size_t i = 0; i < result_.trials.size(); ++i) {
      if (!Passes(result_.trials[i])) continue;
      for (const Solver& solver : Lesser(result_.trials[i].solver)) {
        if (!Try(solver)) return;
      }
    }
  }

  /// Of those that pass; the best is the least by prediction of those that cost the least.
  void MeasureCosts() {
    const std::vector<std::size_t> order = ByPredictedCost();
    std::vector<std::size_t> measured;
    for (const std::size_t i : order) {
      Trial& trial = result_.trials[i];
      if (!Passes(trial) || measured.size() >= kMeasuredMost) continue;
      const double least = result_.trials[measured.empty() ? i : measured[0]].predicted;
      if (trial.predicted > kWorthMeasuring * least) break;
      trial.cost = problem_.measured_cost(trial.solver);
      measured.push_back(i);
    }
    double least_cost = std::numeric_limits<double>::infinity();
    for (const std::size_t i : measured) least_cost = std::min(least_cost, *result_.trials[i].cost);
    for (const std::size_t i : measured) {
      if (*result_.trials[i].cost > kSameCost * least_cost) continue;
      result_.best = i;
      return;
    }
  }

  std::vector<std::size_t> ByPredictedCost() const {
    std::vector<std::size_t> order(result_.trials.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      const Trial& x = result_.trials[a];
      const Trial& y = result_.trials[b];
      return x.predicted != y.predicted ? x.predicted < y.predicted : x.error < y.error;
    });
    return order;
  }

  void FindFront() {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : ByPredictedCost()) {
      Trial& trial = result_.trials[i];
      const bool best = result_.best == i;
      if (!best && (!trial.failure.empty() || trial.error >= least)) continue;
      least = std::min(least, trial.error);
      if (!trial.cost) trial.cost = problem_.measured_cost(trial.solver);
      result_.front.push_back(i);
    }
  }

  const TuneProblem& problem_;
  TuneResult result_;
  std::map<std::string, std::size_t> known_;   // by SolverLines: index of its trial
  double spent_ = 0;
};

}  // namespace

TuneResult Tune(const TuneProblem& problem) { return Search(problem).Run(); }

}  // namespace seam
