#include "tests/support/soak/soak_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/base/geometry.h"
#include "common/measure/joint_drift.h"
#include "common/measure/pose.h"
#include "common/measure/revisions.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

/// A body may have this multiple of the oracle's hottest body's energy...
constexpr double kHottest = 2;
/// ...and besides its energy at this speed, m/s: for players' actions that are not known in time...
constexpr double kUnknown = 3;
/// ...and, where it is shown, for the glide that hides a correction: 4 m/s and more, on top of it.
constexpr double kUnknownShown = 7;
/// In a room without gravity or loss the sum may reach this multiple of the oracle's.
constexpr double kSum = 1.15;
/// A crash: the oracle's joints are open by more than this, m.
constexpr double kCrashDrift = 0.005;
/// A peer that does not know another's input yet may have that crash so many ticks earlier or
/// later.
constexpr std::int64_t kCrashTicks = 12;
/// The engine closes joints that a crash has opened within so many ticks.
constexpr int kCrashOpenTicks = 6;

/// J, by the two last poses shown and by the velocities of physics.
struct Kinetic {
  double shown = 0, moving = 0;
};

Kinetic KineticOf(const MassProperties& mass, const BodyState& before, const BodyState& now,
                  double h) {
  const Eigen::Vector2d way =
      RootFrame(now).ToWorld(mass.centre) - RootFrame(before).ToWorld(mass.centre);
  const double turn = WrapAngle(double{now.angle} - double{before.angle}) / h;
  const double spin = double{now.spin};
  const double shown = mass.mass * (way / h).squaredNorm() + mass.inertia * turn * turn;
  const double moving =
      mass.mass * now.velocity.cast<double>().squaredNorm() + mass.inertia * spin * spin;
  return {shown / 2, moving / 2};
}

/// One composition's meters.
struct Meters {
  explicit Meters(std::shared_ptr<const SceneRevision> of)
      : revision(std::move(of)), joints(revision->scene(), revision->composition()) {
    for (const Assembly& assembly : revision->composition().assemblies) {
      if (assembly.anchored) continue;
      masses.push_back(AssemblyProperties(revision->scene(), assembly));
    }
  }
  std::shared_ptr<const SceneRevision> revision;
  JointMeter joints;
  std::vector<MassProperties> masses;  // of the moving assemblies
};

using Energies = std::map<PartId, Kinetic>;  // by body, summed over the ticks of a second

struct Second {
  int ticks = 0;
  Energies energies;
};

bool IsElasticRoom(const Scene& scene) {
  return scene.gravity.norm() == 0 &&
         std::all_of(scene.parts.begin(), scene.parts.end(),
                     [](const Part& part) { return part.material.restitution >= 1; });
}

class Check {
 public:
  Check(const Recording& recording, const Oracle& oracle, const PhysicsDriftOf& physics_drift)
      : recording_(recording),
        oracle_(oracle),
        physics_drift_(physics_drift),
        scene_(ParseScene(recording.room.scene_text, recording.room.scene_name + ".toml")),
        revisions_(scene_, recording),
        own_(scene_, oracle.edits),
        hz_(std::max(1, recording.room.tick_hz)) {}

  SoakFindings Run() {
    LookAtOracle();
    for (const auto& [peer, views] : recording_.views) LookAt(peer, views);
    LookForLost();
    return found_;
  }

 private:
  const Meters& At(const RevisionHistory& history, int edits) {
    std::unique_ptr<Meters>& meters = meters_[{&history, history.Key(edits)}];
    if (meters == nullptr) meters = std::make_unique<Meters>(history.At(edits));
    return *meters;
  }

  void LookAtOracle() {
    std::map<std::int64_t, Second> seconds;
    std::size_t span = 0;
    int edits = 0;
    for (std::size_t row = 0; row < oracle_.ticks.size(); ++row) {
      bool changed = false;
      for (; span < oracle_.spans.size() && oracle_.spans[span].first_row <= row; ++span) {
        changed = changed || oracle_.spans[span].edits != edits;
        edits = oracle_.spans[span].edits;
      }
      const Meters& meters = At(own_, edits);
      const std::vector<BodyState>& now = oracle_.ticks[row];
      if (now.size() != meters.masses.size()) continue;
      const std::int64_t tick = oracle_.first_tick + static_cast<std::int64_t>(row);
      const double drift = meters.joints.Worst(now, tick);
      drift_ = std::max(drift_, drift);
      if (drift > kCrashDrift) crashes_.insert(tick);
      if (row == 0 || changed) continue;
      Add(meters, oracle_.ticks[row - 1], now, &seconds[tick / hz_]);
    }
    for (const auto& [second, all] : seconds) {
      sums_[second] = Sum(all);
      for (const auto& [id, energy] : all.energies) {
        hottest_ = std::max({hottest_, energy.shown / all.ticks, energy.moving / all.ticks});
      }
    }
  }

  void Add(const Meters& meters, const std::vector<BodyState>& before,
           const std::vector<BodyState>& now, Second* second) {
    ++second->ticks;
    for (std::size_t i = 0; i < now.size(); ++i) {
      mass_[meters.revision->ids[i]] = meters.masses[i].mass;
      const Kinetic now_has = KineticOf(meters.masses[i], before[i], now[i], 1.0 / hz_);
      Kinetic& energy = second->energies[meters.revision->ids[i]];
      energy.shown += now_has.shown;
      energy.moving += now_has.moving;
    }
  }

  static double Sum(const Second& second) {
    double sum = 0;
    for (const auto& [id, energy] : second.energies) {
      sum += std::max(energy.shown, energy.moving) / second.ticks;
    }
    return sum;
  }

  /// True if a view shows exactly the bodies of its revision.
  static bool Whole(const View& view, const Meters& meters) {
    return view.id.size() == meters.revision->ids.size() &&
           std::equal(view.id.begin(), view.id.end(), meters.revision->ids.begin());
  }
  static std::vector<BodyState> StatesOf(const View& view) {
    std::vector<BodyState> states;
    for (std::size_t i = 0; i < view.id.size(); ++i) states.push_back(StateIn(view, i));
    return states;
  }

  void LookAt(int peer, const std::map<std::int64_t, View>& views) {
    std::map<std::int64_t, Second> seconds;
    const View* last = nullptr;
    int open_ticks = 0;
    for (const auto& [tick, view] : views) {
      const View* const before = std::exchange(last, &view);
      const Meters& meters = At(revisions_, view.revision);
      if (!Whole(view, meters)) continue;
      const std::vector<BodyState> now = StatesOf(view);
      found_.compared += static_cast<long>(now.size());
      if (tick < recording_.last_tick - hz_ / 2) {
        LookAtJoints(peer, tick, meters.joints.Worst(now, tick), &open_ticks);
      }
      const bool same = before != nullptr && before->tick == tick - 1 &&
                        revisions_.Key(before->revision) == revisions_.Key(view.revision) &&
                        before->id == view.id;
      if (same) Add(meters, StatesOf(*before), now, &seconds[tick / hz_]);
    }
    for (const auto& [second, all] : seconds) Judge(peer, second, all);
  }

  /// A joint that a peer's engine opens in a crash that the oracle has too, slightly different
  /// since an input was unknown, is displayed as it is. That excuses only a blink.
  void LookAtJoints(int peer, std::int64_t tick, double drift, int* open_ticks) {
    const auto crash = crashes_.lower_bound(tick - kCrashTicks);
    const bool crashes = crash != crashes_.end() && *crash <= tick + kCrashTicks;
    const bool open = crashes && drift - drift_ > kCrashDrift;
    *open_ticks = open ? *open_ticks + 1 : 0;
    const double engine = physics_drift_(peer, tick) - drift_;
    const bool excused = open && *open_ticks <= kCrashOpenTicks && engine > 0;
    if (excused) found_.crashed_m = std::max(found_.crashed_m, engine);
    found_.torn_m = std::max(found_.torn_m, drift - drift_ - (excused ? engine : 0));
  }

  void Judge(int peer, std::int64_t second, const Second& all) {
    if (all.ticks < hz_ / 2) return;
    for (const auto& [id, energy] : all.energies) {
      const auto share_of = [&, mass = mass_.at(id)](double has, double unknown) {
        const double allowed = kHottest * hottest_ + mass * unknown * unknown / 2;
        return allowed > 0 ? has / all.ticks / allowed : 0;
      };
      const double share =
          std::max(share_of(energy.moving, kUnknown), share_of(energy.shown, kUnknownShown));
      if (share <= found_.energy) continue;
      found_.energy = share;
      found_.hottest = "peer " + std::to_string(peer) + " body " + std::to_string(id) + " second " +
                       std::to_string(second);
    }
    const auto due = sums_.find(second);
    if (!IsElasticRoom(scene_) || due == sums_.end() || due->second <= 0) return;
    found_.energy_sum = std::max(found_.energy_sum, Sum(all) / (kSum * due->second));
  }

  /// Finds bodies that the server shows and no client does; and clients' errors of others' bodies.
  void LookForLost() {
    const auto server = recording_.views.find(0);
    if (server == recording_.views.end()) return;
    std::map<PartId, int> missing;  // ticks on end
    for (const auto& [tick, view] : server->second) {
      std::map<PartId, int> now;
      bool any = false;
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const int owner = view.authority[i];
        const std::optional<BodyState> truth = Shown(owner, tick, view.id[i]);
        bool seen = false;
        for (const auto& [peer, views] : recording_.views) {
          if (peer == 0) continue;
          any = any || views.count(tick) > 0;
          const std::optional<BodyState> shown = Shown(peer, tick, view.id[i]);
          seen = seen || shown;
          if (!shown || !truth) continue;
          const double off = double{(shown->position - truth->position).norm()};
          found_.off_m = std::max(found_.off_m, off);
        }
        if (!seen) now[view.id[i]] = missing[view.id[i]] + 1;
      }
      if (!any) continue;
      missing = now;
      for (const auto& [id, ticks] : missing) {
        found_.missing_s = std::max(found_.missing_s, static_cast<double>(ticks) / hz_);
      }
    }
  }

  std::optional<BodyState> Shown(int peer, std::int64_t tick, PartId id) const {
    const auto views = recording_.views.find(peer);
    if (views == recording_.views.end()) return std::nullopt;
    const auto view = views->second.find(tick);
    if (view == views->second.end()) return std::nullopt;
    const int i = IndexOf(view->second, id);
    if (i < 0) return std::nullopt;
    return StateIn(view->second, static_cast<std::size_t>(i));
  }

  const Recording& recording_;
  const Oracle& oracle_;
  const PhysicsDriftOf& physics_drift_;
  const Scene scene_;
  const RevisionHistory revisions_, own_;
  const int hz_;
  std::map<std::pair<const RevisionHistory*, int>, std::unique_ptr<Meters>> meters_;
  std::map<PartId, double> mass_;        // by body, as it was last, kg
  std::map<std::int64_t, double> sums_;  // the oracle's, by second, J
  double hottest_ = 0;                   // the oracle's hottest body in any second, J
  double drift_ = 0;                     // the oracle's worst, m
  std::set<std::int64_t> crashes_;       // ticks at which its joints are open
  SoakFindings found_;
};

}  // namespace

SoakFindings CheckSoak(const Recording& recording, const Oracle& oracle,
                       const PhysicsDriftOf& physics_drift) {
  return Check(recording, oracle, physics_drift).Run();
}

}  // namespace seam
