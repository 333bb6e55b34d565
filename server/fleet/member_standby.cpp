/// A server of a fleet as the standby for rooms of others.

#include <utility>

#include "common/base/process.h"
#include "server/fleet/member.h"

namespace seam {
namespace {

/// A room without a standby is left so long to servers that would follow it, us.
constexpr std::int64_t kLetWarmUs = 1500000;

}  // namespace

Redirect RedirectTo(const std::string& room, const FleetHolder& holder) {
  Redirect to;
  to.room = room;
  to.address = holder.address;
  to.epoch = holder.epoch;
  return to;
}

bool FleetMember::IsAnothers(const FleetRoom& room) const {
  const bool held = room.holder && room.holder->server != config_.me.id;
  return held && held_.count(room.name) == 0 && coming_.count(room.name) == 0;
}

Status FleetMember::TakeDue() {
  if (watch_ == nullptr) return Status::Ok();
  Status status;
  for (StandbyWatch::Due& due : watch_->TakeDue()) {
    // Each gets its answer.
    const Status taken = TakeFrom(std::move(due));
    if (status.ok()) status = taken;
  }
  return status;
}

Status FleetMember::TakeFrom(StandbyWatch::Due due) {
  const std::string& name = due.room.name;
  if (due.epoch > 0) {
    const auto coming = coming_.find(name);
    if (coming == coming_.end() || coming->second != due.epoch) return Status::Ok();
    coming_.erase(coming);
    return TakeHere(due.room, due.epoch, std::move(due.followed));
  }
  std::int32_t epoch = 0;
  Status status;
  const bool may = held_.count(name) == 0 && coming_.count(name) == 0 && takes();
  if (may) status = directory_.TakeFrom(due.room, &epoch);
  if (due.leaving) {
    watch_->Await(name, epoch);
    if (epoch > 0) coming_[name] = epoch;
    return status;
  }
  if (epoch == 0) return status;
  Say("room " + name + ": " + due.room.holder->server + " is silent, and " +
      std::to_string(due.knocking) + " of " + std::to_string(due.present) +
      " player(s) ask for it here");
  return TakeHere(due.room, epoch, std::move(due.followed));
}

void FleetMember::NoteStandbys(const FleetListing& listing) {
  std::map<std::string, std::string> before = std::exchange(guards_, {});
  for (const FleetRoom& room : listing.rooms) {
    if (!room.standby || held_.count(room.name) == 0) continue;
    const std::string& address = guards_[room.name] = room.standby->address;
    if (before[room.name] == address) continue;
    const std::lock_guard<std::mutex> lock(mutex_);
    standbys_.emplace_back(room.name, address);
  }
}

std::vector<std::pair<std::string, std::string>> FleetMember::TakeStandbys() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(standbys_, {});
}

Status FleetMember::StandBy(const FleetRoom& room) {
  const std::int64_t now_us = SteadyClockUs();
  const std::size_t used = held_.size() + coming_.size();
  const bool full = static_cast<std::int32_t>(used) >= config_.me.capacity;
  if (full && room.standby && room.standby->server == config_.me.id) {
    return directory_.StandDown(room.name);
  }
  const auto failed = failed_.find(room.name);
  const bool may = failed == failed_.end() || now_us > failed->second.again_us;
  if (!may || !takes() || !IsAnothers(room) || room.standby || room.state.empty()) {
    unguarded_us_.erase(room.name);
    return Status::Ok();
  }
  const std::int64_t since_us = unguarded_us_.emplace(room.name, now_us).first->second;
  if (full || (!config_.warm && now_us - since_us < kLetWarmUs)) return Status::Ok();
  if (!IsOurs(room.name)) {
    unguarded_us_[room.name] = now_us + kLetWarmUs;  // looks again later
    return Status::Ok();
  }
  bool done = false;
  return directory_.StandBy(room, &done);
}

std::optional<Redirect> FleetMember::Find(const FleetJoin& join) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const FleetRoom& each : listing_.rooms) {
    const bool asked = each.name == join.room || join.room.empty();
    if (!asked || !each.holder) continue;
    const bool ours = each.standby && each.standby->server == config_.me.id;
    if (ours && watch_ != nullptr && join.epoch_proved && join.epoch == each.epoch) {
      watch_->NoteKnock(each.name, join.name, join.place_key);
      LookSoon();  // a drain sends players here before the listing has it
      return Redirect();
    }
    if (each.holder->server == config_.me.id) return Redirect();  // it is being opened
    return RedirectTo(each.name, *each.holder);
  }
  return std::nullopt;
}

std::map<std::string, std::int64_t> FleetMember::StandsBy() const {
  return watch_ == nullptr ? std::map<std::string, std::int64_t>() : watch_->Behind();
}

}  // namespace seam
