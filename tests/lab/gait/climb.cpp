/// Out of the water over a ledge.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {

/// Starts draw the ledge, 0.3 to 0.5 m above the water, the depth, and where it swims.
GaitTrial TryClimb(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr double kTime = 15;  // s
  Random random(static_cast<std::uint64_t>(start));
  const double ledge = random.Uniform(0.3, 0.5), depth = random.Uniform(2.2, 4);
  const double away = random.Uniform(0.8, 2.5), low = random.Uniform(1.3, 1.6);
  const std::string pool = fmt::format(
      "[[part]]\nname = \"ground\"\nfriction = 0.9\nchain = [[-40, {0:.3f}], [-20, {0:.3f}], "
      "[-19.98, {1:.3f}], [-0.02, {1:.3f}], [0, {0:.3f}], [60, {0:.3f}]]\n"
      "[[water]]\nname = \"pool\"\nbox = [20, {2:.3f}]\nposition = [-10, {3:.3f}]\n",
      ledge, -depth, depth, -depth / 2);
  GaitRun run(setup, gains, pool, fmt::format("position = [{:.3f}, {:.3f}]", -away - 0.3, -low));
  run.RunTo(1, 0);
  const double begin = run.time();
  float highest = -10, furthest = -0.3f;  // m; on the ledge
  // Out: it stands on the ledge, behind its edge.
  while (run.time() < begin + kTime) {
    run.Step(1);
    const GaitSight sight = run.Look();
    highest = std::max(highest, sight.centre.y());
    const bool above = sight.centre.y() > static_cast<float>(ledge);
    if (above) furthest = std::max(furthest, std::min(sight.centre.x(), 0.7f));
    if (sight.centre.x() > 0.1f && sight.soles > static_cast<float>(ledge) - 0.1f &&
        run.upright_ticks() >= 30) {
      break;
    }
  }
  GaitTrial trial;
  trial.group = fmt::format("ledge {}", ledge < 0.4 ? "0.3 to 0.4 m" : "0.4 to 0.5 m");
  trial.figure = run.time() - begin;
  trial.good = run.time() < begin + kTime;
  const double up = std::clamp((highest + 0.5) / (ledge + 1.4), 0.0, 1.0);
  const double on = static_cast<double>(furthest) + 0.3;
  trial.cost = trial.good ? 0.3 * trial.figure / kTime : 1.5 - 0.5 * up - 0.5 * on;
  return trial;
}

}  // namespace seam
