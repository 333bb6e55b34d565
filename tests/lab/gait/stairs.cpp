/// Six stairs up, or down.

#include <fmt/format.h>

#include <algorithm>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {
namespace {

constexpr int kSteps = 6;
constexpr double kTread = 0.45;  // m

std::string Stairs(double height) {
  std::string chain = "[[-50, 0]";
  for (int i = 0; i < kSteps; ++i) {
    chain += fmt::format(", [{:.3f}, {:.3f}], [{:.3f}, {:.3f}]", 2 + kTread * i, height * i,
                         2 + kTread * i + (height > 0 ? 0.01 : -0.01), height * (i + 1));
  }
  return "[[part]]\nname = \"ground\"\nfriction = 0.9\nchain = " + chain +
         fmt::format(", [80, {:.3f}]]\n", height * kSteps);
}

}  // namespace

/// Starts go through 15 and 20 cm, up and down, and three drives; where it begins is drawn.
GaitTrial TryStairs(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr float kDrives[] = {0.3f, 0.4f, 0.5f};
  constexpr double kTime = 20;  // s
  Random random(static_cast<std::uint64_t>(start));
  const int index = start - 1;
  const double height = (index / 2 % 2 == 0 ? 0.15 : 0.2) * (index % 2 == 0 ? 1 : -1);
  const float drive = kDrives[index / 4 % 3];
  const double from = random.Uniform(-0.6, 0.6), to = 2 + kTread * kSteps + 1.5;
  GaitRun run(setup, gains, Stairs(height), fmt::format("position = [{:.3f}, 0]", from));
  run.RunTo(0.5, 0);
  bool fell = false;
  while (run.time() < kTime && run.Look().centre.x() < to && !fell) {
    run.Step(drive);
    const GaitSight sight = run.Look();
    fell = sight.head_y - sight.soles < 1.0f;
  }
  const double way = std::clamp((run.Look().centre.x() - from) / (to - from), 0.0, 1.0);
  GaitTrial trial;
  trial.group = fmt::format("{:.0f} cm {}", 100 * std::abs(height), height > 0 ? "up" : "down");
  trial.figure = run.time();
  trial.good = !fell && way >= 1;
  trial.cost = trial.good ? 0.2 * run.time() / kTime : 1.2 - way;
  return trial;
}

}  // namespace seam
