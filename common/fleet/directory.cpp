#include "common/fleet/directory.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "common/base/check.h"
#include "common/base/names.h"
#include "common/base/process.h"
#include "common/fleet/directory_values.h"

namespace seam {
namespace {

using Is = KeyCondition::Is;

/// Time between two looks of Watch, ms.
constexpr int kWatchMs = 200;
/// Most writes with which one room is taken: its epoch, holder, standby, spec and state.
constexpr std::size_t kTakeWritesMost = 5;

bool SameKeys(const std::vector<KeyValue>& a, const std::vector<KeyValue>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.key == y.key && x.changed == y.changed && x.lease == y.lease;
  });
}

}  // namespace

const FleetRoom* FleetListing::FindRoom(const std::string& name) const {
  const auto found =
      std::find_if(rooms.begin(), rooms.end(), [&](const auto& room) { return room.name == name; });
  return found == rooms.end() ? nullptr : &*found;
}

const FleetServer* FleetListing::FindServer(const std::string& id) const {
  const auto found = std::find_if(servers.begin(), servers.end(),
                                  [&](const auto& server) { return server.id == id; });
  return found == servers.end() ? nullptr : &*found;
}

const FleetServer* PlaceRoom(const std::vector<FleetServer>& servers, std::int32_t protocol,
                             const std::string& but, Random& random) {
  std::vector<const FleetServer*> may;
  for (const FleetServer& server : servers) {
    const bool fits = server.protocol == protocol && server.used < server.capacity;
    if (fits && !server.draining && server.id != but) may.push_back(&server);
  }
  if (may.empty()) return nullptr;
  const FleetServer* const a = may[random.Next() % may.size()];
  const FleetServer* const b = may[random.Next() % may.size()];
  // used / capacity, without a division
  const auto share = [](const FleetServer& x, const FleetServer& y) {
    return std::int64_t{x.used} * y.capacity;
  };
  return share(*b, *a) < share(*a, *b) ? b : a;
}

Directory::Directory(std::unique_ptr<KeyStore> store, const std::string& fleet)
    : store_(std::move(store)), prefix_("/seam/" + fleet + "/") {
  SEAM_ASSERT(IsName(fleet));
}

Status Directory::List(FleetListing* listing) {
  std::vector<KeyValue> keys;
  const Status status = store_->List(prefix_, &keys);
  if (!status.ok()) return status;
  *listing = ReadListing(prefix_, keys);
  seen_ = std::move(keys);
  return status;
}

Status Directory::Watch(int wait_ms, FleetListing* listing) {
  const std::vector<KeyValue> before = seen_;
  Status status = List(listing);
  for (int waited = 0; status.ok() && SameKeys(before, seen_) && waited < wait_ms;) {
    const int now_ms = std::min(kWatchMs, wait_ms - waited);
    SleepUs(std::int64_t{now_ms} * 1000);
    waited += now_ms;
    status = List(listing);
  }
  return status;
}

Status Directory::Register(const FleetServer& me) {
  SEAM_ASSERT(IsName(me.id));
  FleetListing listing;
  Status status = List(&listing);
  if (!status.ok()) return status;
  const FleetServer* const there = listing.FindServer(me.id);
  if (there != nullptr && there->address != me.address) {
    return Status::Error("the server " + me.id + " is at " + there->address + ": not this one");
  }
  const std::string key = prefix_ + "servers/" + me.id;
  std::int64_t changed = 0;
  for (const KeyValue& each : seen_) {
    if (each.key == key) changed = each.changed;
  }
  if (lease_ == 0) status = store_->Grant(kFleetLeaseS, &lease_);
  if (!status.ok()) return status;
  bool done = false;
  status =
      store_->Commit({{key, Is::kChangedAt, "", changed}}, {{key, ServerText(me), lease_}}, &done);
  if (status.ok() && !done) {
    status = Status::Error("the server " + me.id + " is another one, which was faster");
  }
  if (!status.ok()) lease_ = 0;
  if (status.ok()) me_ = me;
  if (status.ok() && renewed_us_ == 0) renewed_us_ = SteadyClockUs();
  return status;
}

Status Directory::Renew(bool* kept) {
  *kept = false;
  if (lease_ == 0) return Status::Ok();
  const std::int64_t now_us = SteadyClockUs();
  const Status status = store_->KeepAlive(lease_, kept);
  if (status.ok() && !*kept) lease_ = 0;
  if (status.ok() && *kept) renewed_us_ = now_us;
  return status;
}

Status Directory::RenewIfDue(bool* kept) {
  *kept = lease_ != 0;
  return SteadyClockUs() - renewed_us_ < kRenewUs ? Status::Ok() : Renew(kept);
}

std::string Directory::RoomKey(const std::string& room, const char* what) const {
  return prefix_ + "rooms/" + room + "/" + what;
}

std::string Directory::MyHolderText(std::int32_t epoch) const {
  return HolderTextOf({me_.id, me_.address, epoch});
}

std::string Directory::MyStandbyText() const { return StandbyTextOf({me_.id, me_.address}); }

Status Directory::StandBy(const FleetRoom& room, bool* done) {
  *done = false;
  if (!room.holder || room.holder->server == me_.id) return Status::Ok();
  return store_->Commit({{RoomKey(room.name, "standby"), Is::kAbsent, "", 0},
                         {RoomKey(room.name, "holder"), Is::kChangedAt, "", room.holder_changed},
                         {prefix_ + "servers/" + me_.id, Is::kPresent, "", 0}},
                        {{RoomKey(room.name, "standby"), MyStandbyText(), lease_}}, done);
}

Status Directory::Appoint(const std::string& room, std::int32_t epoch, const FleetServer& standby) {
  bool done = false;
  return store_->Commit(
      {{RoomKey(room, "holder"), Is::kValue, MyHolderText(epoch), 0},
       {prefix_ + "servers/" + standby.id, Is::kPresent, "", 0}},
      {{RoomKey(room, "standby"), StandbyTextOf({standby.id, standby.address}), standby.lease}},
      &done);
}

Status Directory::StandDown(const std::string& room) {
  bool done = false;
  return store_->Commit({{RoomKey(room, "standby"), Is::kValue, MyStandbyText(), 0}},
                        {{RoomKey(room, "standby"), std::nullopt, 0}}, &done);
}

Status Directory::TakeFrom(const FleetRoom& room, std::int32_t* epoch) {
  SEAM_ASSERT(room.holder && room.epoch >= 1);
  *epoch = 0;
  if (room.epoch == std::numeric_limits<std::int32_t>::max()) {
    return Status::Error("room " + room.name + ": there is no epoch left");
  }
  const std::int32_t next = room.epoch + 1;
  bool done = false;
  const Status status =
      store_->Commit({{RoomKey(room.name, "standby"), Is::kValue, MyStandbyText(), 0},
                      {RoomKey(room.name, "holder"), Is::kChangedAt, "", room.holder_changed},
                      {RoomKey(room.name, "epoch"), Is::kChangedAt, "", room.epoch_changed},
                      {prefix_ + "servers/" + me_.id, Is::kPresent, "", 0}},
                     {{RoomKey(room.name, "epoch"), std::to_string(next), 0},
                      {RoomKey(room.name, "holder"), MyHolderText(next), lease_},
                      {RoomKey(room.name, "standby"), std::nullopt, 0}},
                     &done);
  if (status.ok() && done) *epoch = next;
  return status;
}

Status Directory::Claim(const std::string& room, const std::string& spec, std::int32_t least,
                        std::int32_t* epoch) {
  std::vector<std::int32_t> epochs;
  const Status status = ClaimAll({room}, spec, "", least, &epochs);
  *epoch = status.ok() ? epochs.front() : 0;
  return status;
}

Status Directory::ClaimAll(const std::vector<std::string>& rooms, const std::string& spec,
                           const std::string& state, std::int32_t least,
                           std::vector<std::int32_t>* epochs) {
  epochs->assign(rooms.size(), 0);
  FleetListing listing;
  Status status = List(&listing);
  std::map<std::string, const FleetRoom*> known;
  for (const FleetRoom& room : listing.rooms) known[room.name] = &room;
  for (std::size_t r = 0; status.ok() && r < rooms.size();) {
    Change change;
    change.conditions.push_back({prefix_ + "servers/" + me_.id, Is::kPresent, "", 0});
    std::vector<std::int32_t> next;
    for (; r < rooms.size() && change.writes.size() + kTakeWritesMost <= store_->writes_most();
         ++r) {
      const auto found = known.find(rooms[r]);
      status = AddTake(rooms[r], found == known.end() ? nullptr : found->second, least,
                       &next.emplace_back(), &change);
      if (!status.ok()) return status;
      change.writes.push_back({RoomKey(rooms[r], "spec"), spec, 0});
      if (!state.empty()) change.writes.push_back({RoomKey(rooms[r], "state"), state, 0});
    }
    bool done = false, kept = false;
    status = store_->Commit(change.conditions, change.writes, &done);
    if (!status.ok() || !done) return status;
    std::copy(next.begin(), next.end(),
              epochs->begin() + static_cast<std::ptrdiff_t>(r - next.size()));
    if (r < rooms.size()) status = RenewIfDue(&kept);
  }
  return status;
}

Status Directory::TakeOver(const std::string& room, std::int32_t least, std::int32_t* epoch) {
  *epoch = 0;
  FleetListing listing;
  Status status = List(&listing);
  if (!status.ok()) return status;
  Change change;
  std::int32_t next = 0;
  status = AddTake(room, listing.FindRoom(room), least, &next, &change);
  if (!status.ok()) return status;
  change.conditions.push_back({prefix_ + "servers/" + me_.id, Is::kPresent, "", 0});
  change.conditions.push_back({RoomKey(room, "spec"), Is::kPresent, "", 0});
  bool done = false;
  status = store_->Commit(change.conditions, change.writes, &done);
  if (status.ok() && done) *epoch = next;
  return status;
}

Status Directory::AddTake(const std::string& room, const FleetRoom* known, std::int32_t least,
                          std::int32_t* epoch, Change* change) const {
  SEAM_ASSERT(IsName(room) && least >= 1);
  const std::int32_t last = known == nullptr ? 0 : known->epoch;
  if (last == std::numeric_limits<std::int32_t>::max()) {
    return Status::Error("room " + room + ": there is no epoch left");
  }
  *epoch = std::max(last + 1, least);
  change->conditions.push_back({RoomKey(room, "holder"), Is::kAbsent, "", 0});
  change->conditions.push_back(
      {RoomKey(room, "epoch"), Is::kChangedAt, "", known == nullptr ? 0 : known->epoch_changed});
  change->writes.push_back({RoomKey(room, "epoch"), std::to_string(*epoch), 0});
  change->writes.push_back({RoomKey(room, "holder"), MyHolderText(*epoch), lease_});
  change->writes.push_back({RoomKey(room, "standby"), std::nullopt, 0});
  return Status::Ok();
}

Status Directory::TakeBack(const std::string& room, std::int32_t epoch, bool* done) {
  const std::string holder = RoomKey(room, "holder"), mine = MyHolderText(epoch);
  const KeyCondition nobody{holder, Is::kAbsent, "", 0}, before{holder, Is::kValue, mine, 0};
  for (const KeyCondition& held : {nobody, before}) {
    const Status status =
        store_->Commit({held,
                        {RoomKey(room, "epoch"), Is::kValue, std::to_string(epoch), 0},
                        {prefix_ + "servers/" + me_.id, Is::kPresent, "", 0}},
                       {{holder, mine, lease_}}, done);
    if (!status.ok() || *done) return status;
  }
  return Status::Ok();
}

Status Directory::Restore(const std::string& room, std::int32_t epoch, const std::string& spec,
                          bool* done) {
  return store_->Commit({{RoomKey(room, "holder"), Is::kAbsent, "", 0},
                         {RoomKey(room, "epoch"), Is::kAbsent, "", 0},
                         {prefix_ + "servers/" + me_.id, Is::kPresent, "", 0}},
                        {{RoomKey(room, "epoch"), std::to_string(epoch), 0},
                         {RoomKey(room, "spec"), spec, 0},
                         {RoomKey(room, "state"), spec, 0},
                         {RoomKey(room, "holder"), MyHolderText(epoch), lease_}},
                        done);
}

Status Directory::Move(const std::string& room, std::int32_t epoch, const FleetServer& to,
                       std::int32_t* next) {
  *next = 0;
  if (epoch == std::numeric_limits<std::int32_t>::max()) return Status::Ok();
  bool done = false;
  const Status status = store_->Commit(
      {{RoomKey(room, "holder"), Is::kValue, MyHolderText(epoch), 0},
       {prefix_ + "servers/" + to.id, Is::kPresent, "", 0}},
      {{RoomKey(room, "epoch"), std::to_string(epoch + 1), 0},
       {RoomKey(room, "holder"), HolderTextOf({to.id, to.address, epoch + 1}), to.lease},
       {RoomKey(room, "standby"), std::nullopt, 0}},
      &done);
  if (status.ok() && done) *next = epoch + 1;
  return status;
}

Status Directory::SaveState(const std::string& room, std::int32_t epoch, const std::string& state,
                            bool* done) {
  return store_->Commit({{RoomKey(room, "epoch"), Is::kValue, std::to_string(epoch), 0}},
                        {{RoomKey(room, "state"), state, 0}}, done);
}

Status Directory::Release(const std::string& room, std::int32_t epoch) {
  bool done = false;
  return store_->Commit({{RoomKey(room, "holder"), Is::kValue, MyHolderText(epoch), 0}},
                        {{RoomKey(room, "holder"), std::nullopt, 0},
                         {RoomKey(room, "standby"), std::nullopt, 0},
                         {RoomKey(room, "spec"), std::nullopt, 0},
                         {RoomKey(room, "state"), std::nullopt, 0}},
                        &done);
}

Status Directory::GiveUp(const std::string& room, std::int32_t epoch) {
  bool done = false;
  return store_->Commit({{RoomKey(room, "holder"), Is::kValue, MyHolderText(epoch), 0}},
                        {{RoomKey(room, "holder"), std::nullopt, 0}}, &done);
}

Status Directory::Leave() {
  const std::int64_t lease = std::exchange(lease_, 0);
  return lease == 0 ? Status::Ok() : store_->Revoke(lease);
}

}  // namespace seam
