/// Runs beside other runs: the scene's own at a high rate, and the costs of two settings.

#include <algorithm>
#include <cmath>

#include "tests/lab/hard/observe.h"
#include "tests/lab/hard/script_player.h"
#include "tests/lab/hard/settings.h"
#include "tests/lab/hard/thread_clock.h"

namespace seam {
namespace {

/// A reference may have this share of the error that it judges, or this many m.
constexpr double kOwnErrorShare = 0.25, kOwnErrorMin = 1e-5;
constexpr double kNudge = 1e-6;       // m
constexpr int kFinest = 32;           // substeps of 1/60 s
constexpr double kStretch = 0.25;     // s, simulated between two looks at the clock
constexpr double kEnoughUs = 0.15e6;  // CPU time of cost runs
constexpr int kRunsMax = 15;

Scene Refined(const Scene& scene, int substeps) {
  Solver fine = scene.solver;
  fine.tick_hz = 60;
  fine.substeps = substeps;
  fine.velocity_iterations = 8;
  fine.position_iterations = 3;
  return WithSolver(scene, fine);
}

/// A world and the CPU time of its steps.
class Timed {
 public:
  explicit Timed(const Scene& scene) : world_(scene), player_(scene) {}
  void Until(double seconds) {
    const Scene& scene = world_.scene();
    const std::int64_t ticks = std::llround(seconds * scene.solver.tick_hz);
    const double begin_us = ThreadCpuUs();
    while (world_.tick() < ticks) {
      player_.Play(scene, world_.tick() + 1, &world_);
      world_.Step();
    }
    us_ += ThreadCpuUs() - begin_us;
  }
  double us() const { return us_; }

 private:
  World world_;
  ScriptPlayer player_;
  double us_ = 0;
};

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2];
}

}  // namespace

Trajectory PathOf(const Scene& scene, double seconds, int nudged) {
  World world(scene);
  ScriptPlayer hand(scene);
  if (nudged >= 0) {
    BodyState state = world.Read(nudged);
    const float x = state.position.x();
    state.position.x() = std::max(x + static_cast<float>(kNudge), std::nextafter(x, x + 1));
    world.Write(nudged, state, false);
  }
  Trajectory path(scene);
  const std::int64_t ticks = std::llround(seconds * scene.solver.tick_hz);
  path.See(world);
  while (world.tick() < ticks) {
    hand.Play(scene, world.tick() + 1, &world);
    world.Step();
    path.See(world);
  }
  return path;
}

bool Reference::converged() const {
  return change_m <= kOwnErrorShare * stock_m || change_m <= kOwnErrorMin;
}

Reference MakeReference(const Scene& scene, double seconds) {
  Reference reference{PathOf(Refined(scene, kFinest), seconds), 0};
  reference.change_m = Distance(reference.finest, PathOf(Refined(scene, kFinest / 2), seconds));
  return reference;
}

Cost CompareCost(const Scene& scene, const Scene& stock, double seconds) {
  std::vector<double> us, stock_us, ratios;
  double spent_us = 0;
  for (int run = 0; run < kRunsMax && (run == 0 || spent_us < kEnoughUs); ++run) {
    Timed ours(scene), theirs(stock);
    for (int i = 1; (i - 1) * kStretch < seconds; ++i) {
      const double until = std::min(seconds, i * kStretch);
      Timed& first = (i + run) % 2 == 0 ? ours : theirs;
      Timed& second = (i + run) % 2 == 0 ? theirs : ours;
      first.Until(until);
      second.Until(until);
    }
    us.push_back(ours.us() / seconds);
    stock_us.push_back(theirs.us() / seconds);
    ratios.push_back(ours.us() / theirs.us());
    spent_us += ours.us() + theirs.us();
  }
  return {Median(us), Median(stock_us), Median(ratios)};
}

}  // namespace seam
