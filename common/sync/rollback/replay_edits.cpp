/// Replay: edits at their tick. The world goes back to before the edit, is stepped to its tick, is
/// edited there, and continues.
///
///   barrier     tick of the edit                now
///   --|--o--o------o------|-----------|---------o
///     old bodies  new ones, and barriers of them

#include <algorithm>
#include <map>
#include <utility>

#include "common/base/geometry.h"
#include "common/sync/rollback/replay.h"

namespace seam {
namespace {

/// An edit counts as known to all peers after this time, s.
constexpr int kLackMax = 3;

}  // namespace

void Replay::GoBackTo(std::int64_t tick) {
  if (!edits_.empty()) tick = std::max(tick, edits_.back().tick);  // edits keep their order
  if (!journey_ && !barriers_.empty()) {
    tick = std::clamp(tick, barriers_.front().world->tick, world_.tick());
    const std::int64_t asked = std::exchange(from_, -1);  // a pending replay is done on the way
    const std::int64_t from = asked < 0 ? tick : std::min(tick, asked);
    if (from < world_.tick()) Depart(from, true);
  }
  if (!journey_ || tick <= world_.tick()) return;
  BarrierAfterEdits();
  StepTo(std::min(tick, journey_->now));
}

void Replay::CarryShown(const BodyRemap& change) {
  if (!journey_) return;
  std::map<int, const Shown*> before;
  for (const Shown& then : journey_->shown) before[then.body] = &then;
  std::vector<Shown> shown;
  for (std::size_t body = 0; body < change.bodies.size(); ++body) {
    const BodyOrigin& origin = change.bodies[body];
    const auto found = before.find(origin.body);
    if (found == before.end()) continue;  // a new body
    const Shown& then = *found->second;
    shown.push_back({static_cast<int>(body), Carried(origin, then.state), true});
    shown.back().awake = !origin.same || then.awake;
    if (change.jumps.empty()) continue;
    shown.back().state = PlusScaled(shown.back().state, change.jumps[body], 1);
  }
  journey_->shown = std::move(shown);
}

void Replay::Edited(const Edit& edit, bool changed) {
  applied_.emplace_back(world_.topology().revision(), world_.tick());
  while (applied_.front().second < world_.tick() - kLackMax * config_.tick_hz) {
    applied_.pop_front();
  }
  ForgetHeard();
  if (changed) {
    DropBarriers();
    from_ = -1;
    edited_ = true;
    edited_tick_ = world_.tick();
  } else if (!barriers_.empty()) {
    const SeatEdit* seat = edit.As<SeatEdit>();
    const bool there = seat != nullptr && seat->seat >= 0 &&
                       static_cast<std::size_t>(seat->seat) < sitters_.size();
    const int sat = there ? sitters_[static_cast<std::size_t>(seat->seat)] : -1;
    edits_.push_back({edit, world_.tick(), sat});
    ++edits_done_;
  }
  RecordSeats();
}

bool Replay::LacksEdit(int revision, std::int64_t tick) const {
  return std::any_of(applied_.begin(), applied_.end(), [&](const auto& applied) {
    return applied.first > revision && applied.second < tick;
  });
}

/// Forgets states of later ticks, heard or sent: their senders lacked the edit.
void Replay::ForgetHeard() {
  for (const int body : world_.present()) {
    BodyTrack& track = memory_.track(body);
    track.told_tick = std::min(track.told_tick, world_.tick());
  }
  if (!config_.policy->GoesBack(roles_.self())) return;
  Snapshots& heard = memory_.snapshots();
  for (const int body : world_.present()) {
    if (!roles_.Simulates(body)) continue;
    heard.ForgetAfter(body, world_.tick());
    if (!heard.has(body)) heard.Add(body, world_.tick(), world_.Read(body));
  }
}

void Replay::RecordSeats() {
  sitters_.clear();
  for (const Seat& seat : world_.scene().seats) sitters_.push_back(seat.player);
}

/// Restores the seats of the newest barrier's tick. The barrier has everything else.
void Replay::UndoEdits() {
  const auto first = barriers_.back().edits;
  while (edits_done_ > first) {
    const Repeated& done = edits_[static_cast<std::size_t>(--edits_done_ - edits_before_)];
    const SeatEdit* seat = done.edit.As<SeatEdit>();
    if (seat != nullptr) world_.Repeat(Edit(SeatEdit{seat->seat, done.sat}));
  }
}

void Replay::RepeatEdits() {
  const auto end = edits_before_ + static_cast<std::int64_t>(edits_.size());
  for (; edits_done_ < end; ++edits_done_) {
    const Repeated& next = edits_[static_cast<std::size_t>(edits_done_ - edits_before_)];
    if (next.tick > world_.tick()) break;
    world_.Repeat(next.edit);
  }
}

void Replay::AddBarrier(bool alone) {
  barriers_.push_back(
      {std::make_shared<const WorldSnapshot>(alone ? world_.Keep() : world_.Barrier()), edits_done_,
       !alone});
}

void Replay::DropBarriers() {
  barriers_.clear();
  edits_before_ += static_cast<std::int64_t>(edits_.size());
  edits_.clear();
  edits_done_ = edits_before_;
}

bool Replay::IsBeforeEdit(std::int64_t tick) const {
  return config_.policy->GoesBack(roles_.self()) && tick < edited_tick_ &&
         tick >= edited_tick_ - config_.tick_hz;
}

/// Call after edits. Recreated bodies mean a rebuilt world, so this tick becomes a barrier too.
void Replay::BarrierAfterEdits() {
  if (!std::exchange(edited_, false)) return;
  if (config_.policy->BarriersAfterEdits(roles_.self())) AddBarrier(false);
}

void Replay::GoOn() {
  BarrierAfterEdits();
  if (!journey_) return;
  StepTo(journey_->now);
  Arrive();
}

}  // namespace seam
