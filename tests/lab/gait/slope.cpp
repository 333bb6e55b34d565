/// Walking over a slope, up or down, between two levels.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {

/// Starts go through 8 and 17 degrees, up and down, and three drives; where it begins is drawn.
GaitTrial TrySlope(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr double kSlopes[] = {8, -8, 17, -17};  // degrees
  constexpr float kDrives[] = {0.3f, 0.5f, 0.8f};
  constexpr double kFoot = 2, kTop = 8;  // m, where the slope begins and ends
  constexpr double kTime = 20;           // s
  Random random(static_cast<std::uint64_t>(start));
  const int index = start - 1;
  const double degrees = kSlopes[index % 4];
  const float drive = kDrives[index / 4 % 3];
  const double rise = (kTop - kFoot) * std::tan(degrees * kPi / 180);
  const double from = random.Uniform(-0.6, 0.6), to = kTop + 1;
  const std::string ground = fmt::format(
      "[[part]]\nname = \"ground\"\nfriction = 0.9\n"
      "chain = [[-50, 0], [{}, 0], [{}, {:.3f}], [80, {:.3f}]]\n",
      kFoot, kTop, rise, rise);
  GaitRun run(setup, gains, ground, fmt::format("position = [{:.3f}, 0]", from));
  run.RunTo(0.5, 0);
  bool fell = false;
  while (run.time() < kTime && run.Look().centre.x() < to && !fell) {
    run.Step(drive);
    const GaitSight sight = run.Look();
    fell = sight.other || sight.head_y - sight.soles < 1.0f;
  }
  const double way =
      std::clamp((static_cast<double>(run.Look().centre.x()) - from) / (to - from), 0.0, 1.0);
  GaitTrial trial;
  trial.group = fmt::format("{:+.0f} degrees", degrees);
  trial.figure = run.time();
  trial.good = !fell && way >= 1;
  trial.cost = trial.good ? 0.2 * run.time() / kTime : 1.2 - way;
  return trial;
}

}  // namespace seam
