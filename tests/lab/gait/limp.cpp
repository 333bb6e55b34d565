/// Limp for a while, and up again.

#include <fmt/format.h>

#include <cmath>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {

/// Starts go through three causes (its player, a command, a blow) and four drives; when it goes
/// limp and for how long are drawn.
GaitTrial TryLimp(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr float kDrives[] = {0, 0.3f, 0.6f, 1};
  constexpr const char* kCauses[] = {"input", "command", "blow"};
  constexpr double kTime = 15;  // s after it in which it must be up
  Random random(static_cast<std::uint64_t>(start));
  const int cause = (start - 1) % 3;
  const float drive = kDrives[(start - 1) / 3 % 4];
  const double begin = random.Uniform(1.5, 3), limp = random.Uniform(0.3, 2.5);
  const double speed = random.Uniform(3, 6) * (random.Uniform(-1, 1) < 0 ? -1 : 1);  // m/s
  GaitRun run(setup, gains, kFlat, "position = [0, 0]");
  run.RunTo(begin, drive);
  if (cause == 1) run.GoLimp(static_cast<float>(limp));
  if (cause == 2) run.Shove(Vec2(static_cast<float>(speed), 0) * run.Look().mass);
  run.RunTo(begin + limp, 0, cause == 0 ? -1.0f : 0.0f);
  const double end = run.time();
  while (run.time() < end + kTime && run.upright_ticks() < 60) run.Step(0);
  const bool up = run.upright_ticks() >= 60;
  GaitTrial trial;
  trial.group = kCauses[cause];
  trial.figure = run.time() - end - 1;
  trial.good = up;
  trial.cost = up ? 0.5 * trial.figure / kTime
                  : 1.5 - run.upright_ticks() / 120.0 - 0.2 * std::cos(run.Look().torso);
  return trial;
}

}  // namespace seam
