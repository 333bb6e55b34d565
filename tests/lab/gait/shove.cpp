/// A blow of 1 N s per kg on the torso, standing, walking and running.

#include <algorithm>
#include <cmath>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {

/// Starts go through stand, walk and run, from behind and from before; the moment is drawn.
GaitTrial TryShove(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr float kDrives[] = {0, 0.4f, 1.0f};
  constexpr const char* kGroups[] = {"standing", "walking", "running"};
  constexpr double kAfter = 4;  // s
  Random random(static_cast<std::uint64_t>(start));
  const int index = (start - 1) % 3;
  const float side = (start - 1) / 3 % 2 == 0 ? 1.0f : -1.0f;
  GaitRun run(setup, gains, kFlat, "position = [0, 0]");
  run.RunTo(0.5, 0);
  run.RunTo(3 + random.Uniform(0, 0.6), kDrives[index]);
  run.Shove(Vec2(side * run.Look().mass, 0));
  const double at = run.time();
  bool fell = false;
  while (run.time() < at + kAfter && !fell) {
    run.Step(kDrives[index]);
    const GaitSight sight = run.Look();
    fell = sight.other || sight.head_y - sight.soles < 1.0f;
  }
  GaitTrial trial;
  trial.group = kGroups[index];
  trial.figure = run.time() - at;
  trial.good = !fell;
  trial.cost = fell ? 1 - 0.5 * trial.figure / kAfter : 0.2 * std::abs(run.Look().torso);
  return trial;
}

}  // namespace seam
