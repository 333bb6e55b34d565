/// Swimming in water too deep to stand, at a drive that stays as it is.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {
namespace {

constexpr float kSwimDrives[] = {1.0f, 0.6f, 0.3f, 0, -1.0f};
/// m/s that a drive is to give, and the least that is good.
constexpr float kWished[] = {0.8f, 0.5f, 0.3f, 0, -0.4f};
constexpr float kLeast[] = {0.6f, 0.3f, 0.12f, 0, -0.3f};
/// Share of the time with the head's middle above the water.
constexpr double kHeadUp = 0.95;

/// m of the head's middle above the water that cost nothing: swimming, at rest.
constexpr float kFree = 0.06f, kFreeAtRest = 0.15f;

GaitTrial Try(const GaitSetup& setup, const CharacterGains& gains, int start, int index,
              bool plunge);

}  // namespace

GaitTrial TryFloat(const GaitSetup& setup, const CharacterGains& gains, int start) {
  return Try(setup, gains, start, 3, false);
}

GaitTrial TryPlunge(const GaitSetup& setup, const CharacterGains& gains, int start) {
  return Try(setup, gains, start, 3, true);
}

/// Starts go through the drives; depth, angle, height and the moment of the drive are drawn.
GaitTrial TrySwim(const GaitSetup& setup, const CharacterGains& gains, int start) {
  return Try(setup, gains, start, (start - 1) % 5, false);
}

namespace {

/// `plunge`: it falls in or is under the water, at any angle, and has 5 s to come up.
GaitTrial Try(const GaitSetup& setup, const CharacterGains& gains, int start, int index,
              bool plunge) {
  Random random(static_cast<std::uint64_t>(start));
  const float drive = kSwimDrives[index];
  const double depth = random.Uniform(2.2, 6);
  const double lean = plunge ? kPi : 0.8;
  const double angle = random.Uniform(-lean, lean);
  const double low = plunge ? random.Uniform(-1, 1.5) : random.Uniform(1.2, 1.6);
  const double begin = plunge ? 5 : random.Uniform(3, 4.5);
  const std::string pool = fmt::format(
      "[[part]]\nname = \"ground\"\nchain = [[-100, {0:.3f}], [100, {0:.3f}]]\n"
      "[[water]]\nname = \"pool\"\nbox = [200, {1:.3f}]\nposition = [0, {2:.3f}]\n",
      -depth, depth, -depth / 2);
  GaitRun run(setup, gains, pool,
              fmt::format("position = [{:.3f}, {:.3f}]\nangle = {:.3f}", std::sin(angle),
                          plunge ? -low - std::cos(angle) : -low * std::cos(angle), angle));
  run.RunTo(begin, 0);
  int up = 0, ticks = 0;
  double under = 0;
  const auto swim_to = [&](double time) {
    while (run.time() < time) {
      run.Step(drive);
      const float head = run.Look().head_y;
      up += head > 0 ? 1 : 0;
      ++ticks;
      under += std::max(0.0f, (drive == 0 ? kFreeAtRest : kFree) - head);
    }
  };
  constexpr double kFrom = 3, kTo = 10;  // s in which its speed is measured
  swim_to(begin + kFrom);
  const float from = run.Look().centre.x();
  swim_to(begin + kTo);
  const double speed = (run.Look().centre.x() - from) / (kTo - kFrom);
  const double head_up = static_cast<double>(up) / ticks;
  GaitTrial trial;
  trial.group = plunge ? "at any angle" : fmt::format("drive {:.1f}", drive);
  trial.figure = speed;
  const bool fast = drive == 0 ? std::abs(speed) < 0.1
                               : (drive > 0 ? speed >= kLeast[index] : speed <= kLeast[index]);
  trial.good = fast && head_up >= kHeadUp;
  const double missing = drive < 0 ? speed - kWished[index] : kWished[index] - speed;
  const double faster = std::abs(drive) == 1 ? 0.02 : 0.3;  // cost of more than is wished for
  trial.cost = drive == 0 ? std::abs(speed) : 0.2 + std::max(missing, -faster * missing);
  trial.cost += 2 * std::max(0.0, 0.99 - head_up) + 4 * std::min(0.5, under / ticks);
  if (!trial.good) trial.cost += 0.4;
  return trial;
}

}  // namespace

}  // namespace seam
