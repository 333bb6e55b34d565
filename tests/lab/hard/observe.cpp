#include "tests/lab/hard/observe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/check.h"
#include "common/measure/energy.h"
#include "common/measure/joint_drift.h"
#include "common/measure/overlap.h"
#include "common/scene/mass.h"
#include "tests/lab/hard/script_player.h"
#include "tests/lab/hard/thread_clock.h"

namespace seam {
namespace {

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  states.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

bool Lost(const World& world) {
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState s = world.Read(body);
    const bool finite = s.position.allFinite() && s.velocity.allFinite() &&
                        std::isfinite(s.angle) && std::isfinite(s.spin);
    if (!finite || s.position.cast<double>().norm() > kLostBeyond) return true;
  }
  return false;
}

bool AllAsleep(const World& world) {
  for (int body = 0; body < world.body_count(); ++body) {
    if (world.awake(body)) return false;
  }
  return world.body_count() > 0;
}

bool Fed(const Scene& scene) {
  const bool motors = std::any_of(scene.joints.begin(), scene.joints.end(),
                                  [](const Joint& joint) { return joint.motor_torque > 0; });
  const bool scripts = std::any_of(scene.players.begin(), scene.players.end(),
                                   [](const Player& player) { return !player.script.empty(); });
  return motors || scripts;
}

/// The meters of a run, each beyond what it showed at the start.
class Meters {
 public:
  explicit Meters(const World& world)
      : overlap_(world.scene(), world.composition()), joints_(world.scene(), world.composition()) {
    const std::vector<BodyState> states = ReadAll(world);
    overlap_start_ = overlap_.Deepest(states);
    joints_start_ = joints_.Worst(states);
    energy_start_ = MechanicalEnergy(world.scene(), world.composition(), states);
  }
  void See(const World& world) {
    const std::vector<BodyState> states = ReadAll(world);
    deepest_ = std::max(deepest_, overlap_.Deepest(states, world.tick()) - overlap_start_);
    worst_ = std::max(worst_, joints_.Worst(states, world.tick()) - joints_start_);
    const double energy = MechanicalEnergy(world.scene(), world.composition(), states);
    gain_ = std::max(gain_, energy - energy_start_);
  }
  double deepest() const { return deepest_; }
  double worst() const { return worst_; }
  double gain() const { return gain_; }

 private:
  OverlapMeter overlap_;
  JointMeter joints_;
  double overlap_start_ = 0, joints_start_ = 0, energy_start_ = 0;
  double deepest_ = 0, worst_ = 0, gain_ = 0;
};

/// What every run is watched for, whatever its case.
class ReachWatch {
 public:
  ReachWatch(const World& world, std::int64_t ticks) : meters_(world) {
    const int hz = world.scene().solver.tick_hz;
    sample_ticks_ = hz / (world.body_count() > kCrowd ? std::gcd(hz, 10) : CommonHz(hz));
    rest_from_ = ticks - kRestSeconds * hz;
  }

  void See(const World& world, Observation* seen) {
    const bool asleep = AllAsleep(world);
    if (asleep && !seen->asleep_s) {
      seen->asleep_s = static_cast<double>(world.tick()) / world.scene().solver.tick_hz;
    }
    // What slept through since the last look has not moved.
    slept_ = slept_ && asleep;
    if (world.tick() % sample_ticks_ == 0) {
      if (!slept_) meters_.See(world);
      slept_ = asleep;
    }
    if (world.tick() <= rest_from_) return;
    for (int body = 0; body < world.body_count(); ++body) {
      squares_ += world.Read(body).velocity.cast<double>().squaredNorm();
    }
    speeds_ += world.body_count();
  }

  void Conclude(const Scene& scene, Observation* seen) const {
    seen->penetration_m = meters_.deepest();
    seen->joint_drift_m = meters_.worst();
    if (!Fed(scene)) seen->energy_gain = meters_.gain() / EnergyScale(scene);
    if (speeds_ > 0) seen->jitter_mps = std::sqrt(squares_ / static_cast<double>(speeds_));
  }

 private:
  static constexpr int kCrowd = 300, kRestSeconds = 5;
  Meters meters_;
  std::int64_t sample_ticks_ = 1, rest_from_ = 0, speeds_ = 0;
  double squares_ = 0;  // (m/s)^2, summed
  bool slept_ = false;  // all, since the last look of the meters
};

}  // namespace

double EnergyScale(const Scene& scene) {
  const Composition composition = Compose(scene);
  double mass = 0, kinetic = 0;
  for (const Assembly& assembly : composition.assemblies) {
    if (assembly.anchored) continue;
    const MassProperties own = AssemblyProperties(scene, assembly);
    const Part& root = scene.parts[static_cast<std::size_t>(assembly.id)];
    const double spin = static_cast<double>(root.spin);
    mass += own.mass;
    kinetic +=
        own.mass * root.velocity.cast<double>().squaredNorm() / 2 + own.inertia * spin * spin / 2;
  }
  const double scale = kinetic + mass * scene.gravity.cast<double>().norm();
  return scale > 0 ? scale : mass / 2;
}

Observation Observe(const HardCase& hard, const Scene& scene, double seconds,
                    const Trajectory* reference) {
  const std::unique_ptr<Judge> judge = hard.judge ? hard.judge(scene) : nullptr;
  SEAM_ASSERT(judge != nullptr || reference != nullptr);
  World world(scene);
  ScriptPlayer hand(scene);
  Trajectory path(scene);
  const int hz = scene.solver.tick_hz;
  const std::int64_t ticks = std::llround(seconds * hz);
  ReachWatch watch(world, ticks);
  Observation seen;
  double step_us = 0;
  while (true) {
    if (judge) judge->See(world);
    if (!judge) path.See(world);
    watch.See(world, &seen);
    if (world.tick() >= ticks) break;
    hand.Play(scene, world.tick() + 1, &world);
    const double begin_us = ThreadCpuUs();
    world.Step();
    step_us += ThreadCpuUs() - begin_us;
    seen.diverged = Lost(world);
    if (seen.diverged) break;
  }
  seen.seconds = static_cast<double>(world.tick()) / hz;
  if (seen.seconds > 0) seen.cpu_us_per_s = step_us / seen.seconds;
  watch.Conclude(world.scene(), &seen);
  if (!seen.diverged) seen.error = judge ? judge->Error() : Distance(path, *reference);
  seen.failure = judge ? judge->Failure() : "";
  seen.diverged = seen.diverged || !std::isfinite(seen.error);
  if (!seen.diverged) return seen;
  seen.error = std::numeric_limits<double>::infinity();
  if (seen.failure.empty()) seen.failure = fmt::format("diverged at {:.3g} s", seen.seconds);
  return seen;
}

}  // namespace seam
