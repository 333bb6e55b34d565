/// A server of a fleet that drains: others take its rooms, and it moves the rest.

#include <algorithm>

#include "common/base/entropy.h"
#include "common/base/process.h"
#include "server/fleet/member.h"

namespace seam {
namespace {

/// A room of a server that drains is left so long to who may take it, us: a lease, in which one
/// that is not warm becomes its standby and opens it.
constexpr std::int64_t kTakesUs = std::int64_t{kFleetLeaseS} * 1000000;

}  // namespace

void FleetMember::Drain(const std::string& to) {
  const std::lock_guard<std::mutex> lock(mutex_);
  drain_to_ = to;
  draining_ = drains_ = true;
  due_ = true;
  wake_.notify_all();
}

Status FleetMember::FollowDrain(const FleetListing& listing) {
  if (!draining_) return Status::Ok();
  std::string to;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    to = drain_to_;
  }
  bool may = listing.servers.empty();  // the directory does not answer
  for (const FleetServer& server : listing.servers) {
    const bool fits = server.protocol == config_.me.protocol && server.used < server.capacity;
    const bool other = server.id != config_.me.id && !server.draining;
    if (!other || !(to.empty() ? fits : server.address == to)) continue;
    may = true;
    for (const auto& [name, epoch] : held_) {
      const FleetRoom* const room = listing.FindRoom(name);
      if (to.empty() || room == nullptr || (room->standby && room->standby->address == to))
        continue;
      const Status status = directory_.Appoint(name, epoch, server);
      if (!status.ok()) return status;
    }
  }
  const std::int64_t now_us = SteadyClockUs();
  if (held_.size() != left_) gone_us_ = now_us;
  left_ = held_.size();
  drains_ = may && left_ > 0 && now_us - gone_us_ < kTakesUs;
  return Status::Ok();
}

Status FleetMember::KeepHeld(const std::string& room, std::int32_t epoch) {
  bool kept = false, done = false;
  Status status = directory_.RenewIfDue(&kept);
  if (!status.ok() || (kept && directory_.me().draining)) return status;
  FleetServer me = directory_.me();
  me.draining = true;
  status = directory_.Register(me);
  if (!status.ok() || kept) return status;
  return directory_.TakeBack(room, epoch, &done);
}

Redirect FleetMember::Move(const std::string& room, const std::string& to, std::int32_t epoch) {
  const Redirect nowhere;
  FleetListing listing;
  const auto held = held_.find(room);
  // A directory that fails once may answer the next question.
  if (held != held_.end()) (void)KeepHeld(room, held->second);
  if (!directory_.List(&listing).ok()) return nowhere;
  const FleetServer* server = nullptr;
  if (to.empty()) {
    OsEntropy entropy;
    Random random(entropy.Next());
    server = PlaceRoom(listing.servers, config_.me.protocol, config_.me.id, random);
  } else {
    for (const FleetServer& each : listing.servers) {
      if (each.address == to) server = &each;
    }
  }
  std::int32_t next = 0;
  if (held != held_.end() && server != nullptr) {
    const Status status = directory_.Move(room, held->second, *server, &next);
    if (status.ok() && next > 0) {
      held_.erase(held);
      return RedirectTo(room, {server->id, server->address, std::max(next, epoch)});
    }
  }
  if (!directory_.List(&listing).ok()) return nowhere;
  const FleetRoom* const known = listing.FindRoom(room);
  const bool others = known != nullptr && known->holder && known->holder->epoch >= epoch &&
                      known->holder->server != config_.me.id;
  if (!others) return nowhere;
  held_.erase(room);
  return RedirectTo(room, *known->holder);
}

}  // namespace seam
