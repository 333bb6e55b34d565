#include "server/saved/room_keeper.h"

#include <algorithm>
#include <future>
#include <utility>

#include "common/base/process.h"
#include "common/sync/mode.h"
#include "server/room_state.h"
#include "server/saved/old_segments.h"
#include "server/saved/snapshot_file.h"
#include "server/server.h"

namespace seam {

RoomKeeper::RoomKeeper(std::string folder, std::string room, Sink& sink, std::int32_t epoch,
                       std::int64_t keep_s)
    : folder_(std::move(folder)),
      room_(std::move(room)),
      sink_(sink),
      epoch_(epoch),
      keep_s_(keep_s) {}

void RoomKeeper::AfterTick(Server& server, std::int64_t now_us) {
  const int tick_hz = server.room().tick_hz;
  const bool due = server.tick() >= next_tick_ && server.tick() % BarrierEvery(tick_hz) == 0;
  if (!server.started() || server.tick() < 1 || !due || shared_->writing) return;
  next_tick_ = server.tick() + kSnapshotS * tick_hz;
  Save(server, now_us);
}

void RoomKeeper::Save(Server& server, std::int64_t now_us) {
  const std::int64_t begin_us = SteadyClockUs();
  RoomSnapshot snapshot{server.tick(), sink_.Pin(), {}};
  StateDraft copy = server.CopyState(now_us, copied_bytes_);
  longest_us_ = std::max(longest_us_, SteadyClockUs() - begin_us);
  copied_bytes_ = copy.size();
  shared_->writing = true;
  sink_.disk().Do([shared = shared_, folder = folder_, room = room_, epoch = epoch_,
                   keep_s = keep_s_, snapshot = std::move(snapshot),
                   copy = std::move(copy)]() mutable {
    snapshot.room = RoomState::Finish(std::move(copy));
    shared->bytes = snapshot.room.size();
    const Status status = WriteSnapshot(folder, room, snapshot, epoch);
    std::string removed;
    if (status.ok() && keep_s > 0) removed = RemoveOldSegments(folder, room, epoch, keep_s);
    shared->writing = false;
    const std::lock_guard<std::mutex> lock(shared->mutex);
    if (!removed.empty()) shared->news.push_back(removed);
    if (!status.ok() && shared->trouble.ok()) shared->trouble = status;
  });
}

void RoomKeeper::Begin(Server& server, std::int64_t now_us) {
  if (!server.started() || server.tick() < 1) return;
  sink_.Flush();
  RoomSnapshot snapshot{server.tick(), sink_.Pin(), {}};
  snapshot.room = RoomState::Finish(server.CopyState(now_us, copied_bytes_));
  shared_->bytes = copied_bytes_ = snapshot.room.size();
  const Status placed = PlaceSnapshot(folder_, room_, snapshot, epoch_);
  shared_->writing = true;
  sink_.disk().Do([shared = shared_, folder = folder_, room = room_, epoch = epoch_,
                   tick = snapshot.tick, placed] {
    const Status status = placed.ok() ? SyncSnapshot(folder, room, tick, epoch) : placed;
    shared->writing = false;
    const std::lock_guard<std::mutex> lock(shared->mutex);
    if (!status.ok() && shared->trouble.ok()) shared->trouble = status;
  });
}

void RoomKeeper::Finish(Server& server, std::int64_t now_us) {
  if (!server.started() || server.tick() < 1) return;
  sink_.Flush();
  Save(server, now_us);
  std::promise<void> done;
  sink_.disk().Do([&done] { done.set_value(); });
  done.get_future().wait();
}

std::vector<std::string> RoomKeeper::TakeNews() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return std::exchange(shared_->news, {});
}

Status RoomKeeper::trouble() const {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return shared_->trouble;
}

}  // namespace seam
