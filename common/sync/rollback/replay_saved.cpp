/// Replay: its barriers and edits in a saved room. A room that goes on from it can go back as far
/// as the one that was saved, with the same bits.

#include <algorithm>
#include <utility>

#include "common/physics/saved/world_saved.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/edits/edit_order.h"
#include "common/sync/rollback/replay.h"

namespace seam {

std::shared_ptr<const WorldSnapshot> Replay::BarrierNow() {
  if (!config_.policy->TakesBarriers(roles_.self())) {
    return std::make_shared<const WorldSnapshot>(world_.Barrier());
  }
  if (!barriers_.empty() && barriers_.back().world->tick == world_.tick()) barriers_.pop_back();
  AddBarrier(false);
  return barriers_.back().world;
}

std::shared_ptr<const WorldSnapshot> Replay::SharedBarrier(std::int64_t from,
                                                           std::int64_t to) const {
  const auto edited = [this](std::int64_t tick) {  // before the barrier, or after it
    return edited_tick_ == tick ||
           std::any_of(edits_.begin(), edits_.end(),
                       [tick](const Repeated& repeated) { return repeated.tick == tick; });
  };
  for (auto barrier = barriers_.rbegin(); barrier != barriers_.rend(); ++barrier) {
    const std::int64_t tick = barrier->world->tick;
    if (tick < from) break;
    if (tick <= to && barrier->rebuilt && !edited(tick)) return barrier->world;
  }
  return nullptr;
}

bool Replay::GoOnFrom(std::shared_ptr<const WorldSnapshot> barrier) {
  const std::int64_t tick = barrier->tick;
  const bool reached = !barriers_.empty() && barriers_.front().world->tick <= tick;
  if (journey_ || !reached || tick > world_.tick()) return false;
  const auto later = std::find_if(edits_.begin(), edits_.end(),
                                  [tick](const Repeated& edit) { return edit.tick > tick; });
  const std::int64_t before = edits_before_ + (later - edits_.begin());
  barriers_.assign(1, {std::move(barrier), before});
  from_ = tick;
  return true;
}

void Replay::PersistAll(StateArchive& a, std::vector<Barrier>* barriers) {
  a.Section("barriers");
  auto last = std::make_shared<const WorldSnapshot>();
  a.List(barriers, StateArchive::kListMost, [&](Barrier* barrier) {
    WorldSnapshot world;
    if (!a.reading()) world = *barrier->world;
    PersistAfter(a, *last, &world);
    a.Require(world.tick >= last->tick, "its barriers are not in order");
    if (a.reading()) barrier->world = std::make_shared<const WorldSnapshot>(std::move(world));
    last = barrier->world;
    a.Int(&barrier->edits, 0, static_cast<std::int64_t>(StateArchive::kListMost));
  });
}

void Replay::PersistBarriers(StateArchive& a, std::int64_t from) {
  std::vector<Barrier> before;
  if (!a.reading()) {
    for (const Barrier& barrier : barriers_) {
      const std::int64_t tick = barrier.world->tick;
      if (tick < from || tick == world_.tick()) continue;
      before.push_back(barrier);
      before.back().edits -= edits_before_;
    }
    a.Later([before](StateArchive& out) mutable { PersistAll(out, &before); });
    return;
  }
  PersistAll(a, &before);
  for (const Barrier& barrier : before) {
    if (!a.ok()) return;
    const Status status = world_.Load(*barrier.world);
    if (!status.ok()) a.Fail(status.why());
  }
  barriers_.assign(before.begin(), before.end());
}

void Replay::PersistEdits(StateArchive& a) {
  const Scene& scene = world_.scene();
  const auto players = static_cast<std::int64_t>(scene.players.size());
  std::vector<Repeated> edits(edits_.begin(), edits_.end());
  a.List(&edits, StateArchive::kListMost, [&](Repeated* each) {
    seam::Persist(a, &each->edit);
    a.Tick(&each->tick);
    a.Int(&each->sat, -1, players - 1);
    if (!a.reading()) return;
    const SeatEdit* seat = each->edit.As<SeatEdit>();
    const bool sits = seat != nullptr && seat->seat >= 0 && seat->player >= -1 &&
                      seat->player < players &&
                      static_cast<std::size_t>(seat->seat) < scene.seats.size();
    // One that was refused when it was ordered does nothing again.
    if (!sits && !world_.topology().Validate(each->edit).ok()) each->edit = Edit();
  });
  std::vector<std::pair<int, std::int64_t>> applied(applied_.begin(), applied_.end());
  a.List(&applied, StateArchive::kListMost, [&](std::pair<int, std::int64_t>* each) {
    a.Int(&each->first, 0, world_.topology().revision());
    a.Tick(&each->second);
  });
  if (!a.reading()) return;
  edits_.assign(edits.begin(), edits.end());
  applied_.assign(applied.begin(), applied.end());
}

void Replay::Persist(StateArchive& a, std::shared_ptr<const WorldSnapshot> now) {
  a.Section("replay");
  a.Flag(&was_alone_);
  a.Real(&credit_, kSavedSpeedMost);
  a.Tick(&edited_tick_);
  a.Flag(&edited_);
  a.Tick(&from_);
  a.Tick(&missed_);
  PersistEdits(a);
  if (!a.reading() || !a.ok()) return;
  edits_before_ = 0;
  edits_done_ = static_cast<std::int64_t>(edits_.size());
  RecordSeats();
  if (config_.policy->TakesBarriers(roles_.self())) barriers_.push_back({now, edits_done_});
  std::int64_t last = 0, done = 0;
  for (const Barrier& barrier : barriers_) {
    const bool ordered = barrier.world->tick >= last && barrier.edits >= done;
    a.Require(ordered && barrier.edits <= edits_done_, "its barriers have other edits");
    last = barrier.world->tick;
    done = barrier.edits;
  }
  a.Require(from_ < world_.tick() && from_ < last, "it is to go back to a later tick");
}

}  // namespace seam
