#include "common/sync/inputs/input_source.h"

#include "common/base/random.h"

namespace seam {

Input ScriptedInput(const Scene& scene, int player, std::int64_t tick) {
  Input input;
  for (const InputSpan& span : scene.players[static_cast<std::size_t>(player)].script) {
    if (span.from_tick > tick) break;
    input = span.input;
  }
  return input;
}

Input BotInput(std::int64_t seed, int player, std::int64_t tick, int tick_hz) {
  // Time is cut into slots of 0.2 s; each slot draws whether it begins a new decision. The current
  // decision is found by looking back a few slots, without stored state.
  const std::int64_t slot_ticks = tick_hz / 5 > 0 ? tick_hz / 5 : 1;
  const Random base =
      Random(static_cast<std::uint64_t>(seed)).Fork(1000 + static_cast<std::uint64_t>(player));
  for (std::int64_t slot = tick / slot_ticks, back = 0;; --slot, ++back) {
    Random draw = base.Fork(static_cast<std::uint64_t>(slot));
    const bool decides = draw.Chance(0.4) || back == 5 || slot <= 0;
    if (!decides) continue;
    Input input;
    const double kind = draw.Uniform();
    const double drive = kind < 0.5    ? draw.Uniform(0.3, 1.0)
                         : kind < 0.75 ? -draw.Uniform(0.2, 1.0)
                                       : 0.0;
    input.drive = static_cast<std::int8_t>(drive * 127);
    input.lift = static_cast<std::int8_t>(draw.Uniform(-127, 127));
    return input;
  }
}

}  // namespace seam
