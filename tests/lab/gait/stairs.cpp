/// Six stairs up, or down; flights of other stairs down.

#include <fmt/format.h>

#include <algorithm>

#include "common/base/random.h"
#include "tests/lab/gait/gait_run.h"

namespace seam {
namespace {

/// From x = 2 m on.
struct Flight {
  int steps = 6;
  double height = 0, tread = 0.45;  // m; below 0 it goes down
};

std::string Stairs(const Flight& flight) {
  std::string chain = "[[-50, 0]";
  for (int i = 0; i < flight.steps; ++i) {
    const double x = 2 + flight.tread * i;
    chain += fmt::format(", [{:.3f}, {:.3f}], [{:.3f}, {:.3f}]", x, flight.height * i,
                         x + (flight.height > 0 ? 0.01 : -0.01), flight.height * (i + 1));
  }
  return "[[part]]\nname = \"ground\"\nfriction = 0.9\nchain = " + chain +
         fmt::format(", [80, {:.3f}]]\n", flight.height * flight.steps);
}

GaitTrial Walk(const GaitSetup& setup, const CharacterGains& gains, const Flight& flight,
               double from, float drive) {
  constexpr double kTime = 20;  // s
  const double to = 2 + flight.tread * flight.steps + 1.5;
  GaitRun run(setup, gains, Stairs(flight), fmt::format("position = [{:.3f}, 0]", from));
  run.RunTo(0.5, 0);
  bool fell = false;
  while (run.time() < kTime && run.Look().centre.x() < to && !fell) {
    run.Step(drive);
    const GaitSight sight = run.Look();
    fell = sight.head_y - sight.soles < 1.0f;
  }
  const double way = std::clamp((run.Look().centre.x() - from) / (to - from), 0.0, 1.0);
  GaitTrial trial;
  trial.figure = run.time();
  trial.good = !fell && way >= 1;
  trial.cost = trial.good ? 0.2 * run.time() / kTime : 1.2 - way;
  return trial;
}

}  // namespace

/// Starts go through 15 and 20 cm, up and down, and three drives; where it begins is drawn.
GaitTrial TryStairs(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr float kDrives[] = {0.3f, 0.4f, 0.5f};
  Random random(static_cast<std::uint64_t>(start));
  const int index = start - 1;
  Flight flight;
  flight.height = (index / 2 % 2 == 0 ? 0.15 : 0.2) * (index % 2 == 0 ? 1 : -1);
  GaitTrial trial =
      Walk(setup, gains, flight, random.Uniform(-0.6, 0.6), kDrives[index / 4 % 3]);
  trial.group = fmt::format("{:.0f} cm {}", 100 * std::abs(flight.height),
                            flight.height > 0 ? "up" : "down");
  return trial;
}

/// Starts go through 12, 15, 18 and 20 cm; how many there are, the treads, the drive and where it
/// begins are drawn.
GaitTrial TryDescent(const GaitSetup& setup, const CharacterGains& gains, int start) {
  constexpr double kHeights[] = {0.12, 0.15, 0.18, 0.2};
  Random random(static_cast<std::uint64_t>(start));
  Flight flight;
  flight.height = -kHeights[(start - 1) % 4];
  flight.steps = static_cast<int>(random.Uniform(4, 9));
  flight.tread = random.Uniform(0.36, 0.55);
  const double from = random.Uniform(-0.6, 0.6), drive = random.Uniform(0.3, 0.55);
  GaitTrial trial = Walk(setup, gains, flight, from, static_cast<float>(drive));
  trial.group = fmt::format("{:.0f} cm down", -100 * flight.height);
  return trial;
}

}  // namespace seam
