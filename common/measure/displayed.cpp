/// Whether what is shown could be: things in one another, joints apart, energy from nowhere.

#include <algorithm>
#include <cmath>

#include "common/measure/energy.h"
#include "common/measure/joint_drift.h"
#include "common/measure/overlap.h"
#include "common/measure/parts.h"

namespace seam {
namespace {

/// Overlaps are looked for at most this often, Hz: they are the dear ones.
constexpr int kOverlapHz = 10;
/// What is shown may be so late, or so early, against the oracle, s: a blow that comes late is no
/// gain of energy, nor is a motor that starts early.
constexpr double kEnergyWindow = 0.5;

using Bodies = std::vector<BodyState>;

/// The moving bodies as a view shows them; nothing if it does not show exactly those.
std::optional<Bodies> StatesOf(const View& view, const std::vector<PartId>& ids) {
  if (view.id.size() != ids.size() || !std::equal(ids.begin(), ids.end(), view.id.begin())) {
    return std::nullopt;
  }
  Bodies states;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    states.push_back(BodyState{{view.x[i], view.y[i]}, view.angle[i],
                               {view.vx[i], view.vy[i]}, view.spin[i]});
  }
  return states;
}

void Raise(std::optional<double>* most, double value) {
  *most = std::max(most->value_or(value), value);
}

/// The oracle's energy, by tick.
class Budget {
 public:
  Budget(const Oracle& oracle, const EnergyMeter& meter, double h)
      : first_tick_(oracle.first_tick), reach_(std::llround(kEnergyWindow / h)) {
    std::int64_t tick = oracle.first_tick - 1;
    for (const Bodies& states : oracle.ticks) {
      ++tick;
      energies_.push_back(states.empty() ? std::nullopt
                                         : std::optional<double>(meter.Of(states, tick)));
    }
  }
  /// The greatest within the window around a tick that the oracle has.
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

}  // namespace

void MeasureDisplayed(const Recording& recording, const Oracle& oracle, const Scene& scene,
                      const Composition& composition, Measures* measures) {
  std::vector<PartId> ids;
  for (const Assembly& assembly : composition.assemblies) {
    if (!assembly.anchored) ids.push_back(assembly.id);
  }
  if (ids.empty() || oracle.ids != ids) return;
  const OverlapMeter overlap(scene, composition);
  const JointMeter joints(scene, composition);
  const EnergyMeter energy(scene, composition);
  const Budget budget(oracle, energy, TickSeconds(recording));
  const bool jointed = !FindJointEnds(scene, composition).empty();
  const int every = (std::max(1, recording.room.tick_hz) + kOverlapHz - 1) / kOverlapHz;
  for (std::size_t row = 0; row < oracle.ticks.size(); ++row) {
    const Bodies& states = oracle.ticks[row];
    if (states.empty()) continue;
    const std::int64_t tick = oracle.first_tick + static_cast<std::int64_t>(row);
    if (tick % every == 0) Raise(&measures->oracle_penetration_m, overlap.Deepest(states, tick));
    if (jointed) Raise(&measures->oracle_joint_drift_m, joints.Worst(states, tick));
  }
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [tick, view] : views) {
      const std::optional<Bodies> states = StatesOf(view, ids);
      if (!states) continue;
      if (tick % every == 0) Raise(&measures->penetration_m, overlap.Deepest(*states, tick));
      if (jointed) Raise(&measures->joint_drift_m, joints.Worst(*states, tick));
      const std::optional<double> due = budget.Around(tick);
      if (due) Raise(&measures->energy_gain_j, std::max(0.0, energy.Of(*states, tick) - *due));
    }
  }
}

}  // namespace seam
