#include "tests/lab/hard/tune.h"

#include <algorithm>
#include <limits>
#include <map>

#include "tests/lab/hard/settings.h"

namespace seam {
namespace {

/// How far behind the first that passes the coarse grid is searched.
constexpr double kBeyondFirst = 2;
/// Whose cost is measured: so many whose runs took least, and so many of the least predicted.
constexpr std::size_t kMeasuredMax = 12, kPredictedMax = 3;
/// What two timings of one setting may differ by.
constexpr double kSameCost = 1.05;
/// From how many of the cheapest the search goes on to their neighbours, and how often.
constexpr std::size_t kClimbers = 3, kClimbs = 4;
constexpr float kTunedSkin = 0.0025f;  // m

class Search {
 public:
  explicit Search(const TuneProblem& problem) : problem_(problem) {}

  TuneResult Run() {
    Try(problem_.own);
    if (problem_.jointed) TryExact();
    Coarse();
    Refine();
    for (std::size_t i = 0; i < kClimbs; ++i) Climb();
    ChooseBest();
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
    Trial trial;
    trial.solver = solver;
    trial.predicted = problem_.predicted(solver);
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

  void TryExact() {
    for (const int substeps : {1, 2, 4}) {
      Solver s = problem_.own;
      const Solver usual;
      s.substeps = SubstepsMin(s.tick_hz);
      s.velocity_iterations = usual.velocity_iterations;
      s.position_iterations = usual.position_iterations;
      s.joints = JointSolving::kExact;
      s.joint_substeps = substeps;
      Try(s);
    }
  }

  std::vector<Solver> Grid() const {
    std::vector<Solver> grid;
    std::vector<int> rates = {20, 30, 60, 120, 240};
    if (problem_.keep_hz) rates = {problem_.own.tick_hz};
    const std::vector<std::pair<int, int>> iterations = {{1, 1}, {2, 1}, {4, 1}, {8, 3}, {16, 4}};
    for (const float skin : {0.0f, kTunedSkin}) {
      for (const int hz : rates) {
        for (const int substeps : {1, 2, 3, 4, 6, 8}) {
          if (substeps < SubstepsMin(hz)) continue;
          for (const auto& [velocity, position] : iterations) {
            Solver s = problem_.own;
            if (problem_.jointed) s.joints = JointSolving::kIterative;
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
    for (int Solver::*lever :
         {&Solver::substeps, &Solver::velocity_iterations, &Solver::position_iterations}) {
      Solver less = solver;
      less.*lever -= 1;
      if (less.*lever >= 1 && less.substeps >= SubstepsMin(less.tick_hz)) lesser.push_back(less);
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

  /// Tries what is a little more or less than the cheapest that pass.
  void Climb() {
    std::vector<std::size_t> cheapest = Passing();
    cheapest.resize(std::min(cheapest.size(), kClimbers));
    for (const std::size_t i : cheapest) {
      const Solver from = result_.trials[i].solver;
      std::vector<Solver> neighbours = Lesser(from);
      Solver more = from;
      more.substeps = std::min(32, from.substeps + 1);
      neighbours.push_back(more);
      more = from;
      more.velocity_iterations = std::min(64, from.velocity_iterations * 5 / 4 + 1);
      neighbours.push_back(more);
      more = from;
      more.skin = kTunedSkin;
      neighbours.push_back(more);
      for (const Solver& solver : neighbours) {
        if (!Try(solver)) return;
      }
    }
  }

  /// What passes, by what its run took.
  std::vector<std::size_t> Passing() const {
    std::vector<std::size_t> passing;
    for (std::size_t i = 0; i < result_.trials.size(); ++i) {
      if (Passes(result_.trials[i])) passing.push_back(i);
    }
    SortBy(&passing, [](const Trial& trial) { return trial.run_cost; });
    return passing;
  }

  template <typename Key>
  void SortBy(std::vector<std::size_t>* indices, Key key) const {
    std::stable_sort(indices->begin(), indices->end(), [&](std::size_t a, std::size_t b) {
      const Trial& x = result_.trials[a];
      const Trial& y = result_.trials[b];
      return key(x) != key(y) ? key(x) < key(y) : x.error < y.error;
    });
  }

  double CostOf(std::size_t i) {
    Trial& trial = result_.trials[i];
    if (!trial.cost) trial.cost = problem_.measured_cost(trial.solver);
    return *trial.cost;
  }

  /// Whether `i` costs as little as `least`. Where one timing denies it, both are timed again: on a
  /// busy machine one may come out as anything.
  bool CostsAsLittle(std::size_t i, std::size_t least) {
    if (CostOf(i) <= kSameCost * CostOf(least)) return true;
    const double again = problem_.measured_cost(result_.trials[i].solver);
    if (again > kSameCost * problem_.measured_cost(result_.trials[least].solver)) return false;
    result_.trials[i].cost = again;
    return true;
  }

  void ChooseBest() {
    std::vector<std::size_t> candidates = Passing();
    if (candidates.empty()) return;
    std::vector<std::size_t> foretold = candidates;
    SortBy(&foretold, [](const Trial& trial) { return trial.predicted; });
    foretold.resize(std::min(foretold.size(), kPredictedMax));
    candidates.resize(std::min(candidates.size(), kMeasuredMax));
    candidates.insert(candidates.end(), foretold.begin(), foretold.end());
    std::size_t least = candidates.front();
    for (const std::size_t i : candidates) {
      if (CostOf(i) < CostOf(least)) least = i;
    }
    SortBy(&candidates, [](const Trial& trial) { return trial.predicted; });
    for (const std::size_t i : candidates) {
      if (!CostsAsLittle(i, least)) continue;
      result_.best = i;
      return;
    }
  }

  /// Of `from`, sorted by cost, those that are better than all before them.
  std::vector<std::size_t> Better(const std::vector<std::size_t>& from) const {
    std::vector<std::size_t> better;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : from) {
      const Trial& trial = result_.trials[i];
      if (!trial.failure.empty() || trial.error >= least) continue;
      least = trial.error;
      better.push_back(i);
    }
    return better;
  }

  void FindFront() {
    std::vector<std::size_t> all(result_.trials.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    SortBy(&all, [](const Trial& trial) { return trial.run_cost; });
    for (const std::size_t i : Better(all)) CostOf(i);
    const auto unmeasured = [&](std::size_t i) { return !result_.trials[i].cost; };
    all.erase(std::remove_if(all.begin(), all.end(), unmeasured), all.end());
    SortBy(&all, [](const Trial& trial) { return *trial.cost; });
    result_.front = Better(all);
  }

  const TuneProblem& problem_;
  TuneResult result_;
  std::map<std::string, std::size_t> known_;  // by SolverLines: index of its trial
  double spent_ = 0;
};

}  // namespace

TuneResult Tune(const TuneProblem& problem) { return Search(problem).Run(); }

}  // namespace seam
