/// Kinetic energy in every second, by peers' displayed poses and by their velocities, against the
/// oracle's.

#include <algorithm>
#include <cmath>

#include "common/measure/parts.h"
#include "common/measure/screen/path.h"
#include "common/measure/screen/screen.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

/// Windows in which the oracle has less than this share of its greatest energy are ignored.
constexpr double kShareMin = 0.05;

/// Energy, J: by the poses of two successive ticks (posed), and by the states' velocities (moving).
struct Kinetic {
  double posed = 0, moving = 0;

  Kinetic& operator+=(const Kinetic& o) {
    posed += o.posed;
    moving += o.moving;
    return *this;
  }
};

/// Returns the energy by poses. A pose is of the root part, so the centre of mass is computed.
double Posed(const MassProperties& mass, const BodyState& before, const BodyState& now, double h) {
  const Eigen::Vector2d v =
      (RootFrame(now).ToWorld(mass.centre) - RootFrame(before).ToWorld(mass.centre)) / h;
  const double spin = WrapAngle(double{now.angle} - double{before.angle}) / h;
  return (mass.mass * v.squaredNorm() + mass.inertia * spin * spin) / 2;
}

double Moving(const MassProperties& mass, const BodyState& now) {
  const double spin = double{now.spin};
  return (mass.mass * now.velocity.cast<double>().squaredNorm() + mass.inertia * spin * spin) / 2;
}

Kinetic Of(const MassProperties& mass, const BodyState& before, const BodyState& now, double h) {
  return {Posed(mass, before, now, h), Moving(mass, now)};
}

/// Energies of one peer in one window: sums over its bodies and ticks, and the oracle's for the
/// same bodies and ticks.
struct Window {
  Kinetic shown, due;
  Kinetic hottest, hottest_due;  // greatest of any body
};

/// Masses of bodies by number of edits.
class Masses {
 public:
  explicit Masses(const RevisionHistory& revisions) : revisions_(revisions) {}
  const MassProperties& Of(int edits, PartId id) {
    const auto [place, made] = known_.try_emplace({revisions_.Key(edits), id});
    if (!made) return place->second;
    const auto revision = revisions_.At(edits);
    const int of = revision->AssemblyOf(id);
    const auto& all = revision->composition().assemblies;
    if (of >= 0) {
      place->second = AssemblyProperties(revision->scene(), all[static_cast<std::size_t>(of)]);
    }
    return place->second;
  }

 private:
  const RevisionHistory& revisions_;
  std::map<std::pair<int, PartId>, MassProperties> known_;
};

void Raise(Kinetic* most, const Kinetic& value) {
  most->posed = std::max(most->posed, value.posed);
  most->moving = std::max(most->moving, value.moving);
}

/// Adds one body of one peer to that peer's windows.
void Add(const std::vector<const View*>& views, const Oracle& oracle,
         const RevisionHistory& revisions, PartId id, double h, Masses* masses,
         std::vector<Window>* windows) {
  const auto length = static_cast<std::size_t>(std::llround(1 / h));
  for (std::size_t w = 0; w * length < views.size(); ++w) {
    if (windows->size() <= w) windows->emplace_back();
    Kinetic shown, due;
    for (std::size_t t = std::max<std::size_t>(1, w * length);
         t < std::min(views.size(), (w + 1) * length); ++t) {
      const View *now = views[t], *before = views[t - 1];
      const int i = now == nullptr ? -1 : IndexOf(*now, id);
      const int k = before == nullptr ? -1 : IndexOf(*before, id);
      if (i < 0 || k < 0 || !revisions.SameBody(now->revision, before->revision, id)) continue;
      const std::optional<BodyState> truth = oracle.At(now->tick, id);
      const std::optional<BodyState> was = oracle.At(now->tick - 1, id);
      if (!truth || !was || !oracle.SameBody(now->tick, now->tick - 1, id)) continue;
      const MassProperties& mass = masses->Of(now->revision, id);
      shown += Of(mass, StateIn(*before, static_cast<std::size_t>(k)),
                  StateIn(*now, static_cast<std::size_t>(i)), h);
      due += Of(mass, *was, *truth, h);
    }
    Window& window = (*windows)[w];
    window.shown += shown;
    window.due += due;
    Raise(&window.hottest, shown);
    Raise(&window.hottest_due, due);
  }
}

void Note(double value, double due, double due_min, Measures* measures) {
  if (due <= 0 || due < due_min) return;
  const double ratio = value / due;
  measures->energy_ratio_min = std::min(measures->energy_ratio_min.value_or(ratio), ratio);
  measures->energy_ratio_max = std::max(measures->energy_ratio_max.value_or(ratio), ratio);
}

}  // namespace

void MeasureKinetic(const Recording& recording, const Oracle& oracle,
                    const RevisionHistory& revisions, Measures* measures) {
  const double h = TickSeconds(recording);
  Masses masses(revisions);
  std::vector<Window> all;
  const std::vector<PartId> ids = ShownIds(recording);
  for (const auto& [peer, of_peer] : recording.views) {
    const std::vector<const View*> views = ViewsByTick(recording, peer);
    // An incomplete last window has fewer ticks, of peer and oracle alike.
    std::vector<Window> windows;
    for (const PartId id : ids) Add(views, oracle, revisions, id, h, &masses, &windows);
    all.insert(all.end(), windows.begin(), windows.end());
  }
  Kinetic most, hottest, hottest_due;
  for (const Window& window : all) {
    Raise(&most, window.due);
    Raise(&hottest, window.hottest);
    Raise(&hottest_due, window.hottest_due);
  }
  for (const Window& window : all) {
    Note(window.shown.posed, window.due.posed, kShareMin * most.posed, measures);
    Note(window.shown.moving, window.due.moving, kShareMin * most.moving, measures);
  }
  for (const auto& [value, due] : {std::pair{hottest.posed, hottest_due.posed},
                                   std::pair{hottest.moving, hottest_due.moving}}) {
    if (due <= 0) continue;
    measures->hottest_ratio = std::max(measures->hottest_ratio.value_or(0), value / due);
  }
}

}  // namespace seam
