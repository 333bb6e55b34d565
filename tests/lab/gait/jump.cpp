/// A running jump: 2 to 6 s of running, lift for a quarter of a second, and 3 s to run on. It takes
/// 3.5 s to come to full speed, where the push is shortest.

#include <fmt/format.h>

#include <algorithm>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {
namespace {

/// m that the soles must come up.
constexpr float kSolesMin = 0.25f;
constexpr float kJumpDrives[] = {0.3f, 0.6f, 1.0f};
/// s of a stride, over which the starts' phases are spread.
constexpr double kStride = 0.6;

}  // namespace

/// Starts 1 to 24 are three drives at eight phases; later ones are drawn between them, every second
/// one at full drive.
GaitTrial TryJump(const GaitSetup& setup, const CharacterGains& gains, int start) {
  Random random(static_cast<std::uint64_t>(start));
  const int index = start - 1;
  float drive = kJumpDrives[index % 3];
  double at = 2.5 + kStride * (index / 3) / 8;
  if (index >= 24) {
    drive = index % 2 == 0 ? 1.0f : static_cast<float>(random.Uniform(0.3, 1.0));
    at = 2.0 + random.Uniform(0, 4);
  }
  GaitRun run(setup, gains, kFlat, "position = [0, 0]");
  run.RunTo(0.5, 0);
  run.RunTo(at, drive);
  GaitTrial trial;
  trial.group =
      index < 24 ? fmt::format("drive {:.1f}", drive) : (drive < 1 ? "drive 0.3 to 1" : "drive 1");
  float soles = 0;
  double landed = 0;
  int lying = 0;  // ticks
  bool flew = false;
  while (run.time() < (landed > 0 ? landed + 3 : at + 2)) {
    run.Step(drive, run.time() < at + 0.25 ? 1 : 0);
    const GaitSight sight = run.Look();
    flew = flew || (run.time() < at + 1.2 && !sight.feet && sight.soles > 0.1f);
    if (flew && landed == 0) soles = std::max(soles, sight.soles);
    if (flew && landed == 0 && (sight.feet || sight.other)) landed = run.time();
    lying += sight.other ? 1 : 0;
  }
  trial.figure = soles;
  trial.good = landed > 0 && lying == 0 && soles >= kSolesMin;
  trial.cost = landed > 0 ? std::min(lying, 60) / 60.0 : 1;
  trial.cost += 2 * std::max(0.0, 1.15 * kSolesMin - soles);
  return trial;
}

}  // namespace seam
