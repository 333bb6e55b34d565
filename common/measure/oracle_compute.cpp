/// The simulated oracle: one world, the recorded inputs, and the edits with an external cause.

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/measure/measure.h"
#include "common/measure/outside_edits.h"
#include "common/measure/owners.h"
#include "common/measure/recorded_inputs.h"
#include "common/measure/revisions.h"
#include "common/physics/world.h"
#include "common/scene/expected.h"
#include "common/sync/method.h"
#include "common/sync/mode.h"

namespace seam {
namespace {

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  states.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

/// Applies edits to the world. Returns true, and begins a span at `row`, if they change bodies or
/// joints.
bool Change(const std::vector<Edit>& edits, std::size_t row, World* world, Oracle* oracle) {
  if (edits.empty()) return false;
  if (oracle->spans.empty()) oracle->Begin(0, SceneRevision(world->topology()), 0);
  bool changed = false;
  for (const Edit& edit : edits) {  // one by one, as every peer does
    oracle->edits.push_back(edit);
    oracle->edit_ticks.push_back(oracle->first_tick + static_cast<std::int64_t>(row));
    if (world->Apply({edit})) changed = true;
  }
  if (!changed) return false;
  oracle->Begin(row, SceneRevision(world->topology()), static_cast<int>(oracle->edits.size()));
  return true;
}

void RequireMemory(std::int64_t kept, const Recording& recording) {
  if (kept <= kOracleStatesMax) return;
  throw OperatorError("the session is too long for an oracle: " +
                      std::to_string(recording.last_tick) + " ticks with changing bodies");
}

/// Returns the ticks between two barriers of a peer in a recorded room. Before protocol 14 each
/// send tick was one.
int BarrierEveryOf(const Room& room) {
  constexpr std::int32_t kBarriersApart = 14;
  if (room.protocol >= kBarriersApart) return BarrierEvery(std::max(1, room.tick_hz));
  return std::max(1, std::max(1, room.tick_hz) / std::max(1, room.send_hz));
}

}  // namespace

bool JudgedByBarriers(const Room& room) { return PolicyOf(room).TakesBarriers(0); }

OracleOptions WithBarriers(const Room& room) {
  OracleOptions options;
  options.barrier_every = BarrierEveryOf(room);
  options.barrier_after_edits = PolicyOf(room).GoesBack(0);
  return options;
}

OracleOptions JudgeOf(const Room& room) {
  return JudgedByBarriers(room) ? WithBarriers(room) : OracleOptions();
}

Oracle ComputeOracle(const Recording& recording, const OracleOptions& options) {
  Scene scene = RecordedScene(recording.room);
  scene.solver.tick_hz = recording.room.tick_hz;
  World world(scene);
  if (options.nudged_body >= 0) {
    BodyState state = world.Read(options.nudged_body);
    // At least to the next float: 40 m from the origin a micrometre is lost in rounding.
    const float x = state.position.x();
    state.position.x() = std::max(x + options.nudge, std::nextafter(x, x + 1));
    world.Write(options.nudged_body, state, false);
  }
  Oracle oracle;
  for (int body = 0; body < world.body_count(); ++body) oracle.ids.push_back(world.id(body));
  const std::int64_t states = std::max(1, world.body_count());
  if (recording.last_tick > kOracleStatesMax / states) {
    throw OperatorError(
        "the session is too long for an oracle: " + std::to_string(recording.last_tick) +
        " ticks of " + std::to_string(states) + " bodies");
  }
  const RecordedInputs inputs(recording, scene);
  const bool watch = scene.expected->contact;
  const std::map<PartId, int> owners = watch ? FindOwners(world) : std::map<PartId, int>();
  if (watch) oracle.contact = false;
  // In a recording with edits the views may have other bodies than the oracle from the start.
  if (!recording.edits.empty()) oracle.Begin(0, SceneRevision(world.topology()), 0);
  OutsideEdits outside(recording, scene);
  Change(outside.Take(0, world.scene()), 0, &world, &oracle);
  oracle.ticks.push_back(ReadAll(world));
  if (options.barrier_every > 0) world.Barrier();
  std::int64_t kept = 0;
  for (std::int64_t tick = 1; tick <= recording.last_tick; ++tick) {
    for (const int player : inputs.players()) inputs.Apply(&world, player, tick);
    world.Step();
    if (watch && !*oracle.contact) oracle.contact = OwnersTouch(world, owners);
    const std::vector<Edit> found = world.ProposeEdits();
    if (options.barrier_every > 0 && tick % options.barrier_every == 0) world.Barrier();
    const std::size_t spans = oracle.spans.size(), row = oracle.ticks.size();
    bool changed = Change(found, row, &world, &oracle);
    changed = Change(outside.Take(tick, world.scene()), row, &world, &oracle) || changed;
    if (changed && options.barrier_after_edits) world.Barrier();
    kept += world.body_count();
    if (oracle.spans.size() > spans) {
      kept += static_cast<std::int64_t>(world.scene().parts.size());
    }
    RequireMemory(kept, recording);
    oracle.ticks.push_back(ReadAll(world));
  }
  oracle.Identify(recording, scene);
  return oracle;
}

}  // namespace seam
