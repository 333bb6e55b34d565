#include "common/measure/growing_oracle.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/codec/event.h"
#include "common/measure/owners.h"
#include "common/measure/revisions.h"
#include "common/scene/expected.h"
#include "common/sync/method.h"
#include "common/sync/mode.h"

namespace seam {
namespace {

Scene SceneOf(const Room& room) {
  Scene scene = RecordedScene(room);
  scene.solver.tick_hz = room.tick_hz;
  return scene;
}

std::vector<BodyState> ReadAll(const World& world) {
  std::vector<BodyState> states;
  states.reserve(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
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

GrowingOracle::GrowingOracle(const Room& room, const OracleOptions& options)
    : options_(options),
      scene_(SceneOf(room)),
      world_(scene_),
      outside_(scene_),
      watch_(scene_.expected->contact),
      owners_(watch_ ? FindOwners(world_) : std::map<PartId, int>()) {
  if (options.nudged_body >= 0) {
    BodyState state = world_.Read(options.nudged_body);
    // At least to the next float: 40 m from the origin a micrometre is lost in rounding.
    const float x = state.position.x();
    state.position.x() = std::max(x + options.nudge, std::nextafter(x, x + 1));
    world_.Write(options.nudged_body, state, false);
  }
  for (int body = 0; body < world_.body_count(); ++body) oracle_.ids.push_back(world_.id(body));
  if (watch_) oracle_.contact = false;
}

void GrowingOracle::Hear(const Recording& recording) {
  inputs_.Add(recording, scene_);
  outside_.Add(recording);
  // In a recording with edits the views may have other bodies than the oracle from the start.
  if (!recording.edits.empty() && oracle_.spans.empty())
    oracle_.Begin(0, SceneRevision(world_.topology()), 0);
  if (!oracle_.ticks.empty()) return;
  TakeOutside(0);
  oracle_.ticks.push_back(ReadAll(world_));
  if (options_.barrier_every > 0) world_.Barrier();
}

void GrowingOracle::Step() {
  ++tick_;
  for (const int player : inputs_.players()) inputs_.Apply(&world_, player, tick_);
  world_.Step();
  if (watch_ && !*oracle_.contact) oracle_.contact = OwnersTouch(world_, owners_);
  const std::vector<Edit> found = world_.ProposeEdits();
  if (options_.barrier_every > 0 && tick_ % options_.barrier_every == 0) world_.Barrier();
  const std::size_t row = oracle_.ticks.size();
  bool changed = Change(found, row);
  changed = TakeOutside(row) || changed;
  if (changed && options_.barrier_after_edits) world_.Barrier();
  oracle_.ticks.push_back(ReadAll(world_));
}

void GrowingOracle::Forget(std::int64_t before_tick) {
  for (; forgotten_ < std::min(before_tick, tick_); ++forgotten_)
    oracle_.ticks[static_cast<std::size_t>(forgotten_)] = {};
  inputs_.Forget(std::min(before_tick, tick_));
}

bool GrowingOracle::TakeOutside(std::size_t row) {
  return Change(outside_.Take(tick_, world_.scene()), row);
}

/// Applies edits to the world. Returns true, and begins a span at `row`, if they change bodies or
/// joints.
bool GrowingOracle::Change(const std::vector<Edit>& edits, std::size_t row) {
  if (edits.empty()) return false;
  if (oracle_.spans.empty()) oracle_.Begin(0, SceneRevision(world_.topology()), 0);
  bool changed = false;
  for (const Edit& edit : edits) {  // one by one, as every peer does
    oracle_.edits.push_back(edit);
    oracle_.edit_ticks.push_back(static_cast<std::int64_t>(row));
    if (world_.Apply({edit})) changed = true;
  }
  if (!changed) return false;
  oracle_.Begin(row, SceneRevision(world_.topology()), static_cast<int>(oracle_.edits.size()));
  return true;
}

bool JudgedByBarriers(const Room& room) { return PolicyOf(room).TakesBarriers(0); }

OracleOptions WithBarriers(const Room& room) {
  OracleOptions options;
  options.barrier_every = BarrierEveryOf(room);
  options.barrier_after_edits = PolicyOf(room).BarriersAfterEdits(0);
  return options;
}

OracleOptions JudgeOf(const Room& room) {
  return JudgedByBarriers(room) ? WithBarriers(room) : OracleOptions();
}

std::string WhyNoOracle(const Recording& recording) {
  const auto has = [&](EventKind kind) {
    return std::any_of(
        recording.events.begin(), recording.events.end(),
        [kind](const Event& event) { return event.kind == static_cast<std::int8_t>(kind); });
  };
  if (recording.first_tick <= 0 || has(EventKind::kStarted)) return "";
  const std::string tick = std::to_string(recording.first_tick);
  return has(EventKind::kResumed) ? "the room goes on at tick " + tick + " of an earlier session"
                                  : "the log begins at tick " + tick + " of its session";
}

void RequireBeginning(const Recording& recording) {
  const std::string why = WhyNoOracle(recording);
  if (!why.empty()) throw OperatorError("no oracle: " + why);
}

Oracle ComputeOracle(const Recording& recording, const OracleOptions& options) {
  RequireBeginning(recording);
  GrowingOracle growing(recording.room, options);
  const std::int64_t states = std::max(1, growing.world().body_count());
  if (recording.last_tick > kOracleStatesMax / states) {
    throw OperatorError(
        "the session is too long for an oracle: " + std::to_string(recording.last_tick) +
        " ticks of " + std::to_string(states) + " bodies");
  }
  growing.Hear(recording);
  std::int64_t kept = 0;
  while (growing.tick() < recording.last_tick) {
    const std::size_t spans = growing.oracle().spans.size();
    growing.Step();
    kept += growing.world().body_count();
    if (growing.oracle().spans.size() > spans)
      kept += static_cast<std::int64_t>(growing.world().scene().parts.size());
    RequireMemory(kept, recording);
  }
  growing.Identify(recording);
  return growing.Take();
}

}  // namespace seam
