/// Walking and running on level ground at a drive, and stopping.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {

/// Starts go through five drives; the friction of the ground and the moments are drawn.
GaitTrial TryWalk(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr float kWalkDrives[] = {0.3f, 0.6f, 1.0f, -0.5f, -1.0f};
  Random random(static_cast<std::uint64_t>(start));
  const float drive = kWalkDrives[(start - 1) % 5];
  const std::string ground =
      fmt::format("[[part]]\nname = \"ground\"\nchain = [[-200, 0], [200, 0]]\nfriction = {:.3f}\n",
                  random.Uniform(0.6, 1));
  GaitRun run(setup, gains, ground, "position = [0, 0]");
  const double begin = random.Uniform(0.4, 1);
  bool fell = false;
  const auto to = [&](double time, float now) {
    while (run.time() < time && !fell) {
      run.Step(now);
      const GaitSight sight = run.Look();
      fell = sight.other || sight.head_y - sight.soles < 1.0f;
    }
  };
  to(begin, 0);
  to(begin + 2, drive);
  const float from = run.Look().centre.x();
  to(begin + 6, drive);
  const double speed = (run.Look().centre.x() - from) / 4;
  to(begin + 9, 0);  // it stops
  const double rest = run.Look().velocity.norm();
  const double wished = static_cast<double>(drive) * (drive > 0 ? 3.0 : 1.2);
  GaitTrial trial;
  trial.group = fmt::format("drive {:.1f}", drive);
  trial.figure = speed;
  trial.good = !fell && rest < 0.2 && std::abs(speed - wished) < 0.4 * std::abs(wished);
  trial.cost = fell ? 1 + 0.5 * (1 - run.time() / (begin + 9))
                    : 0.5 * std::abs(speed - wished) / std::abs(wished) + 0.2 * std::min(1.0, rest);
  return trial;
}

}  // namespace seam
