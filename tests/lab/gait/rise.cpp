/// Getting up from back or front, on level ground and on slopes.

#include <fmt/format.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {

/// Starts go through five slopes and two sides; the lie is drawn.
GaitTrial TryRise(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr double kSlopes[] = {0, 10, -10, 17, -17};  // degrees
  constexpr double kTime = 8;                          // s in which it must be up
  Random random(static_cast<std::uint64_t>(start));
  const double degrees = kSlopes[(start - 1) % 5];
  const double slope = degrees * kPi / 180;
  const bool front = (start - 1) / 5 % 2 == 0;
  const double angle = slope + (front ? -1 : 1) * kPi / 2 + random.Uniform(-0.15, 0.15);
  const double above = random.Uniform(0.25, 0.45);
  const double rise = 100 * std::tan(slope);
  const std::string ground = fmt::format(
      "[[part]]\nname = \"ground\"\nchain = [[-100, {:.3f}], [100, {:.3f}]]\n"
      "friction = 0.9\n",
      -rise, rise);
  GaitRun run(setup, gains, ground,
              fmt::format("position = [{:.3f}, {:.3f}]\nangle = {:.3f}", -above * std::sin(slope),
                          above * std::cos(slope), angle));
  // The lean that hides in the fall is not yet a stand.
  run.RunTo(0.5, 0);
  while (run.time() < kTime + 1 && run.upright_ticks() < 60) run.Step(0);
  const bool up = run.upright_ticks() >= 60;
  GaitTrial trial;
  trial.group = fmt::format("{:+.0f} degrees, {}", degrees, front ? "front" : "back");
  trial.figure = run.time() - 1;
  trial.good = up;
  trial.cost = up ? 0.5 * trial.figure / kTime
                  : 1.5 - run.upright_ticks() / 120.0 - 0.2 * std::cos(run.Look().torso);
  return trial;
}

}  // namespace seam
