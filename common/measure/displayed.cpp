/// Physical plausibility of displayed states: overlaps, drifted joints, gained energy.

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/measure/energy.h"
#include "common/measure/joint_drift.h"
#include "common/measure/overlap.h"
#include "common/measure/parts.h"

namespace seam {
namespace {

/// Greatest rate of overlap tests, Hz: the most expensive of these measures.
constexpr int kOverlapHz = 10;
/// Views may lag or lead the oracle by this, s: a late impact is no gain of energy, nor is a motor
/// that starts early.
constexpr double kEnergyWindow = 0.5;

using Bodies = std::vector<BodyState>;

/// Returns the moving bodies as a view shows them; nullopt if it does not show exactly `ids`.
std::optional<Bodies> StatesOf(const View& view, const std::vector<PartId>& ids) {
  if (view.id.size() != ids.size() || !std::equal(ids.begin(), ids.end(), view.id.begin())) {
    return std::nullopt;
  }
  Bodies states;
  for (std::size_t i = 0; i < ids.size(); ++i) states.push_back(StateIn(view, i));
  return states;
}

/// The meters for the states of one revision.
struct Meters {
  explicit Meters(const SceneRevision& revision)
      : ids(revision.ids),
        overlap(revision.scene(), revision.composition()),
        joints(revision.scene(), revision.composition()),
        energy(revision.scene(), revision.composition()),
        jointed(!FindJointEnds(revision.scene(), revision.composition()).empty()) {}
  const std::vector<PartId> ids;
  const OverlapMeter overlap;
  const JointMeter joints;
  const EnergyMeter energy;
  const bool jointed;
};

void Raise(std::optional<double>* most, double value) {
  *most = std::max(most->value_or(value), value);
}

/// The oracle's energy by tick.
class Budget {
 public:
  Budget(std::int64_t first_tick, double h)
      : first_tick_(first_tick), reach_(std::llround(kEnergyWindow / h)) {}
  void Add(std::optional<double> energy) { energies_.push_back(energy); }
  /// Returns the greatest energy within the window around a tick; nullopt if the oracle lacks it.
  std::optional<double> Around(std::int64_t tick) const {
    const std::int64_t last = static_cast<std::int64_t>(energies_.size()) - 1;
    const std::int64_t at = tick - first_tick_;
    if (at < 0 || at > last || !energies_[static_cast<std::size_t>(at)]) return std::nullopt;
    std::optional<double> most;
    for (std::int64_t i = std::max<std::int64_t>(0, at - reach_); i <= std::min(last, at + reach_);
         ++i) {
      if (energies_[static_cast<std::size_t>(i)]) {
        Raise(&most, *energies_[static_cast<std::size_t>(i)]);
      }
    }
    return most;
  }

 private:
  std::int64_t first_tick_, reach_;
  std::vector<std::optional<double>> energies_;
};

/// Measures the oracle itself, row by row, each with the bodies of its time.
Budget MeasureOracle(const Oracle& oracle, const RevisionHistory& own, double h, int every,
                     Measures* measures) {
  Budget budget(oracle.first_tick, h);
  std::size_t span = 0;
  auto meters = std::make_unique<Meters>(*own.At(0));
  for (std::size_t row = 0; row < oracle.ticks.size(); ++row) {
    while (span < oracle.spans.size() && oracle.spans[span].first_row <= row) {
      const int edits = oracle.spans[span++].edits;
      if (edits > 0) meters = std::make_unique<Meters>(*own.At(edits));
    }
    const Bodies& states = oracle.ticks[row];
    if (states.size() != meters->ids.size() || states.empty()) {
      budget.Add(std::nullopt);
      continue;
    }
    const std::int64_t tick = oracle.first_tick + static_cast<std::int64_t>(row);
    budget.Add(meters->energy.Of(states, tick));
    if (tick % every == 0) {
      Raise(&measures->oracle_penetration_m, meters->overlap.Deepest(states, tick));
    }
    if (meters->jointed) {
      Raise(&measures->oracle_joint_drift_m, meters->joints.Worst(states, tick));
    }
  }
  return budget;
}

}  // namespace

void MeasureDisplayed(const Recording& recording, const Oracle& oracle,
                      const RevisionHistory& revisions, Measures* measures) {
  const auto first = revisions.At(0);
  if (oracle.spans.empty() && (first->ids.empty() || oracle.ids != first->ids)) return;
  const int every = (std::max(1, recording.room.tick_hz) + kOverlapHz - 1) / kOverlapHz;
  const RevisionHistory own(first->scene(), oracle.edits);
  const Budget budget = MeasureOracle(oracle, own, TickSeconds(recording), every, measures);
  // One revision after the other: meters are expensive to make and large to keep.
  std::map<int, std::vector<const View*>> by_revision;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views)
      by_revision[revisions.Key(view.revision)].push_back(&view);
  }
  for (const auto& [key, views] : by_revision) {
    const Meters meters(*revisions.At(key));
    if (meters.ids.empty()) continue;
    for (const View* view : views) {
      const std::optional<Bodies> states = StatesOf(*view, meters.ids);
      if (!states) continue;
      if (view->tick % every == 0) {
        Raise(&measures->penetration_m, meters.overlap.Deepest(*states, view->tick));
      }
      if (meters.jointed) {
        Raise(&measures->joint_drift_m, meters.joints.Worst(*states, view->tick));
      }
      const std::optional<double> due = budget.Around(view->tick);
      if (due) {
        Raise(&measures->energy_gain_j,
              std::max(0.0, meters.energy.Of(*states, view->tick) - *due));
      }
    }
  }
}

}  // namespace seam
