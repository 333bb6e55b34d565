/// The truth a recording is measured against: simulated alone, or taken from another recording.

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/measure/measure.h"
#include "common/physics/world.h"

namespace seam {
namespace {

/// One player's recorded inputs by tick. Where pieces overlap they agree; the first one stands.
using InputTicks = std::map<std::int64_t, Input>;

InputTicks TicksOf(const std::map<std::int64_t, Inputs>& pieces) {
  InputTicks ticks;
  for (const auto& [first_tick, piece] : pieces) {
    for (std::size_t i = 0; i < piece.drive.size(); ++i) {
      ticks.try_emplace(first_tick + static_cast<std::int64_t>(i),
                        Input{piece.drive[i], piece.lift[i], piece.buttons[i]});
    }
  }
  return ticks;
}

/// Sets a player's axes for `tick`, if they were recorded, and does what its buttons going down do.
void Apply(World& world, int player, const InputTicks& inputs, std::int64_t tick) {
  const auto now = inputs.find(tick);
  if (now == inputs.end()) return;
  world.SetInput(player, now->second);
  const int before = now == inputs.begin() ? 0 : std::prev(now)->second.buttons;
  const int pressed = now->second.buttons & ~before;
  const auto& actions = world.scene().players[static_cast<std::size_t>(player)].actions;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if ((pressed >> actions[a].button) & 1) world.Act(player, static_cast<int>(a));
  }
}

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  states.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

}  // namespace

const BodyState* Oracle::At(std::int64_t tick, PartId id) const {
  if (tick < first_tick) return nullptr;
  const auto row = static_cast<std::size_t>(tick - first_tick);
  const auto found = std::lower_bound(ids.begin(), ids.end(), id);
  if (row >= ticks.size() || ticks[row].empty() || found == ids.end() || *found != id) {
    return nullptr;
  }
  return &ticks[row][static_cast<std::size_t>(found - ids.begin())];
}

Oracle ComputeOracle(const Recording& recording, int nudged_body, float nudge) {
  Scene scene = ParseScene(recording.room.scene_text, recording.room.scene_name + ".toml");
  scene.solver.tick_hz = recording.room.tick_hz;
  World world(scene);
  if (nudged_body >= 0) {
    BodyState state = world.Read(nudged_body);
    // At least to the next float: 40 m from the origin a micrometre is lost in rounding.
    const float x = state.position.x();
    state.position.x() = std::max(x + nudge, std::nextafter(x, x + 1));
    world.Write(nudged_body, state, false);
  }
  Oracle oracle;
  for (int body = 0; body < world.body_count(); ++body) oracle.ids.push_back(world.id(body));
  const std::int64_t states = std::max(1, world.body_count());
  if (recording.last_tick > kOracleStatesMax / states) {
    throw OperatorError("the session is too long for an oracle: " +
                        std::to_string(recording.last_tick) + " ticks of " +
                        std::to_string(states) + " bodies");
  }
  std::map<int, InputTicks> inputs;
  for (const auto& [player, pieces] : recording.inputs) {
    const bool known = player >= 0 && static_cast<std::size_t>(player) < scene.players.size();
    if (known) inputs[player] = TicksOf(pieces);
  }
  oracle.ticks.push_back(ReadAll(world));
  for (std::int64_t tick = 1; tick <= recording.last_tick; ++tick) {
    for (const auto& [player, ticks] : inputs) Apply(world, player, ticks, tick);
    world.Step();
    oracle.ticks.push_back(ReadAll(world));
  }
  return oracle;
}

Oracle OracleFromRecording(const Recording& recording) {
  if (recording.room.mode != "oracle") {
    throw OperatorError("the oracle's recording was made with --mode " + recording.room.mode +
                        ", not --mode oracle");
  }
  const auto views = recording.views.find(0);
  if (views == recording.views.end() || views->second.empty()) {
    throw OperatorError("the oracle's recording has no views of the server");
  }
  Oracle oracle;
  oracle.first_tick = views->second.begin()->first;
  const View& first = views->second.begin()->second;
  oracle.ids.assign(first.id.begin(), first.id.end());
  const std::int64_t count = views->second.rbegin()->first - oracle.first_tick + 1;
  oracle.ticks.resize(static_cast<std::size_t>(count));
  for (const auto& [tick, view] : views->second) {
    if (view.id != first.id) continue;
    auto& states = oracle.ticks[static_cast<std::size_t>(tick - oracle.first_tick)];
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      states.push_back(BodyState{{view.x[i], view.y[i]}, view.angle[i],
                                 {view.vx[i], view.vy[i]}, view.spin[i]});
    }
  }
  return oracle;
}

}  // namespace seam
