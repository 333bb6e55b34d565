/// Replay: edits at their tick. The world goes back to before the edit, is stepped again to its
/// tick, changes there, and goes on with what it has become.
///
///   barrier     tick of the edit                now
///   --|--o--o------o------|-----------|---------o
///     old bodies  new ones, and barriers of them

#include <algorithm>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/correct/replay.h"

namespace seam {

void Replay::GoBackTo(std::int64_t tick) {
  if (!journey_ && !barriers_.empty()) {
    tick = std::clamp(tick, barriers_.front().tick, world_.tick());
    const std::int64_t asked = std::exchange(from_, -1);  // what waits is done on the way
    const std::int64_t from = asked < 0 ? tick : std::min(tick, asked);
    if (from < world_.tick()) Depart(from);
  }
  if (!journey_ || tick <= world_.tick()) return;
  BarrierAfterEdits();
  StepTo(std::min(tick, journey_->now));
}

void Replay::Remap(const BodyRemap& change) {
  if (!journey_) return;
  std::vector<Shown> shown;
  for (std::size_t body = 0; body < change.bodies.size(); ++body) {
    const BodyOrigin& origin = change.bodies[body];
    shown.emplace_back();
    shown.back().known = origin.body >= 0;
    if (origin.body < 0) continue;
    const Shown& before = journey_->shown[static_cast<std::size_t>(origin.body)];
    shown.back().state = Carried(origin, before.state);
    shown.back().awake = !origin.same || before.awake;
    if (change.jumps.empty()) continue;
    shown.back().state = PlusScaled(shown.back().state, change.jumps[body], 1);
  }
  journey_->shown = std::move(shown);
  FindPressed(journey_->from);
}

void Replay::Edited(bool changed) {
  barriers_.clear();
  from_ = -1;
  edited_ = true;
  if (changed) edited_tick_ = world_.tick();
  rebuilt_ = rebuilt_ || changed;
}

bool Replay::IsBeforeEdit(std::int64_t tick) const {
  return config_.GoesBack(roles_.self()) && tick < edited_tick_ &&
         tick >= edited_tick_ - config_.tick_hz;
}

/// Where bodies have become others the world is built anew, so this is a tick to go back to, too.
/// Elsewhere only those are at which every peer takes a barrier.
void Replay::BarrierAfterEdits() {
  if (!std::exchange(edited_, false)) return;
  const bool rebuilt = std::exchange(rebuilt_, false);
  if (!config_.GoesBack(roles_.self())) return;
  if (rebuilt || world_.tick() % config_.send_every() == 0) barriers_.push_back(world_.Barrier());
}

void Replay::GoOn() {
  BarrierAfterEdits();
  if (!journey_) return;
  StepTo(journey_->now);
  Arrive();
}

}  // namespace seam
