#include "tests/lab/hard/overhead.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "common/physics/world.h"
#include "tests/lab/hard/raw_box2d.h"
#include "tests/lab/hard/script_player.h"
#include "tests/lab/hard/thread_clock.h"

namespace seam {
namespace {

/// Ticks between two looks at the clock: its 0.3 us must be little beside them.
constexpr int kStepsPerLook = 16;

/// A world of either kind with the hand that plays its scripts.
template <typename AnyWorld>
struct Lane {
  explicit Lane(const Scene& scene) : world(scene), hand(scene) {}
  /// us of CPU time.
  double Steps(const Scene& scene, int ticks) {
    const double begin_us = ThreadCpuUs();
    for (int i = 0; i < ticks; ++i) {
      hand.Play(scene, world.tick() + 1, &world);
      world.Step();
    }
    return ThreadCpuUs() - begin_us;
  }
  AnyWorld world;
  ScriptPlayer hand;
};

}  // namespace

Overhead MeasureOverhead(const Scene& given, int ticks, int repeats) {
  Scene scene = given;
  scene.solver.joints = JointSolving::kIterative;  // as the engine alone
  const auto stretches = static_cast<std::size_t>((ticks + kStepsPerLook - 1) / kStepsPerLook);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> raw_us(stretches, kNone), core_us(stretches, kNone);
  Overhead result;
  result.equal = true;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Lane<RawBox2d> raw(scene);
    Lane<World> core(scene);
    result.bodies = core.world.body_count();
    for (std::size_t i = 0; i < stretches; ++i) {
      const int count = std::min(kStepsPerLook, ticks - static_cast<int>(i) * kStepsPerLook);
      // In turn who goes first: the first finds the cache as the other left it.
      const bool raw_first = (i + static_cast<std::size_t>(repeat)) % 2 == 0;
      if (raw_first) raw_us[i] = std::min(raw_us[i], raw.Steps(scene, count));
      core_us[i] = std::min(core_us[i], core.Steps(scene, count));
      if (!raw_first) raw_us[i] = std::min(raw_us[i], raw.Steps(scene, count));
    }
    result.equal = result.equal && raw.world.Hash() == core.world.Hash();
  }
  for (std::size_t i = 0; i < stretches; ++i) {
    result.raw_us_per_step += raw_us[i] / ticks;
    result.core_us_per_step += core_us[i] / ticks;
  }
  return result;
}

}  // namespace seam
