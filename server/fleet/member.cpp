#include "server/fleet/member.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/base/check.h"
#include "common/base/json_text.h"
#include "common/base/process.h"
#include "server/saved/snapshot_file.h"

namespace seam {
namespace {

/// Time between two rounds, ms: a lease of kFleetLeaseS is renewed twenty times.
constexpr int kRoundMs = 250;
/// The same while it drains, ms: a room that was taken ticks on for that time, and the next one
/// waits.
constexpr int kDrainRoundMs = 5;
/// Least time between two rounds that joins bring about, us: they may be a stranger's.
constexpr std::int64_t kLookSoonUs = 50000;
/// A room that cannot be opened here is left to others for so long, us; twice as long after each
/// further failure, up to the most: each try costs an epoch.
constexpr std::int64_t kFailedUs = 10000000, kFailedMostUs = 3600000000;

}  // namespace

FleetMember::FleetMember(const Config& config, Prepare prepare)
    : config_(config),
      prepare_(std::move(prepare)),
      directory_(OpenKeyStore(config.directory), config.fleet) {
  const Status status = directory_.Register(config.me);
  if (!status.ok()) throw OperatorError("--directory " + config.directory + ": " + status.why());
}

FleetMember::~FleetMember() {
  Stop();
  (void)directory_.Leave();  // else the lease ends by itself
}

std::int32_t FleetMember::Claim(const std::string& room, std::int32_t least) {
  return ClaimAll({room}, least).front();
}

std::vector<std::int32_t> FleetMember::ClaimAll(const std::vector<std::string>& rooms,
                                                std::int32_t least) {
  std::vector<std::int32_t> epochs;
  const std::string spec = SpecOfRooms();
  const Status status =
      directory_.ClaimAll(rooms, spec, config_.folder.empty() ? "" : spec, least, &epochs);
  if (!status.ok()) throw OperatorError("--directory " + config_.directory + ": " + status.why());
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    if (epochs[r] > 0) held_[rooms[r]] = epochs[r];
  }
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    if (epochs[r] > 0) continue;
    const std::string why = WhyNotClaimed(rooms[r]);
    if (!why.empty()) throw OperatorError(why);
  }
  if (std::count(epochs.begin(), epochs.end(), 0) == 0) return epochs;
  throw OperatorError(
      "--directory " + config_.directory +
      ": another server took a room at the same time, and has let it go: try again");
}

std::string FleetMember::WhyNotClaimed(const std::string& room) {
  FleetListing listing;
  const Status status = directory_.List(&listing);
  if (!status.ok()) return "--directory " + config_.directory + ": " + status.why();
  if (listing.FindServer(config_.me.id) == nullptr) {
    return "--directory " + config_.directory + ": the lease of this server, of " +
           std::to_string(kFleetLeaseS) + " s, ended while it claimed its rooms";
  }
  const FleetRoom* const known = listing.FindRoom(room);
  if (known == nullptr || !known->holder) return "";
  return "room " + room + " is held by " + known->holder->server + " at " + known->holder->address;
}

std::string FleetMember::SpecOfRooms() const {
  return "{\"folder\": " + JsonText(config_.folder) + "}";
}

bool FleetMember::Knows(const std::string& room) {
  FleetListing listing;
  bool kept = false;  // rooms are read between two of these calls, which takes a while
  Status status = directory_.RenewIfDue(&kept);
  if (status.ok()) status = directory_.List(&listing);
  if (!status.ok()) throw OperatorError("--directory " + config_.directory + ": " + status.why());
  const FleetRoom* const known = listing.FindRoom(room);
  return known != nullptr && !known->spec.empty();
}

void FleetMember::Start() {
  stop_ = false;
  if (config_.takes) {
    const auto wake = [this] {
      const std::lock_guard<std::mutex> lock(mutex_);
      due_ = true;
      wake_.notify_all();
    };
    watch_ = std::make_unique<StandbyWatch>(
        StandbyWatch::Config{config_.folder, config_.warm, config_.log_key, wake});
  }
  thread_ = std::thread([this] { Run(); });
}

void FleetMember::Stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    wake_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  watch_.reset();
}

void FleetMember::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    lock.unlock();
    const Status status = Round();
    if (!status.ok()) (void)FollowDrain(FleetListing());
    lock.lock();
    if (up_.exchange(status.ok()) != status.ok()) {
      news_.push_back(status.ok() ? "the directory answers again"
                                  : "no directory: the rooms go on (" + status.why() + ")");
    }
    round_us_ = SteadyClockUs();
    const int round_ms = draining_ ? kDrainRoundMs : kRoundMs;
    wake_.wait_for(lock, std::chrono::milliseconds(round_ms), [this] { return stop_ || due_; });
    due_ = false;
  }
}

void FleetMember::LookSoon() {
  if (SteadyClockUs() - round_us_ < kLookSoonUs) return;
  due_ = true;
  wake_.notify_all();
}

Status FleetMember::Renew() {
  const std::int64_t now_us = SteadyClockUs();
  const bool lately = now_us - renewed_us_ < std::int64_t{kRoundMs} * 1000;
  if (lately && draining_ == directory_.me().draining) return Status::Ok();
  bool kept = false;
  Status status = directory_.Renew(&kept);
  if (!status.ok()) return status;
  FleetServer me = config_.me;
  me.used = static_cast<std::int32_t>(held_.size() + coming_.size());
  me.draining = draining_;
  const FleetServer& was = directory_.me();
  if (!kept || me.used != was.used || me.draining != was.draining) {
    status = directory_.Register(me);
  }
  if (status.ok()) renewed_us_ = now_us;
  return status;
}

Status FleetMember::Round() {
  Status status = TakeDue();  // first: players wait
  if (status.ok()) status = Renew();
  if (status.ok()) status = GiveUpUnopened();
  if (!status.ok()) return status;
  FleetListing listing;
  status = directory_.List(&listing);
  if (!status.ok()) return status;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    listing_ = listing;
    if (listing.refused != refused_ && !listing.refused.empty()) {
      news_.push_back("the directory has a value that is ignored: " + listing.refused);
    }
    refused_ = listing.refused;
  }
  std::vector<StandbyWatch::Guarded> guarded;
  for (const FleetRoom& room : listing.rooms) {
    status = LookAt(room);
    if (status.ok()) status = StandBy(room);
    if (!status.ok()) return status;
    const bool ours = room.standby && room.standby->server == config_.me.id;
    if (!ours || !IsAnothers(room)) continue;
    const FleetServer* const holder = listing.FindServer(room.holder->server);
    guarded.push_back({room, takes() && holder != nullptr && holder->draining});
  }
  if (watch_ != nullptr) watch_->Set(guarded);
  NoteStandbys(listing);
  for (const auto& [room, epoch] : held_) {
    bool done = false;
    if (listing.FindRoom(room) != nullptr) continue;
    status = directory_.Restore(room, epoch, SpecOfRooms(), &done);
    if (!status.ok()) return status;
    if (done) Say("room " + room + ": the directory had lost it, and has it again");
  }
  return FollowDrain(listing);
}

Status FleetMember::LookAt(const FleetRoom& room) {
  const auto held = held_.find(room.name);
  const bool mine = room.holder && room.holder->server == config_.me.id;
  if (held != held_.end()) {
    if (room.epoch > held->second && !mine) {
      held_.erase(held);
      const std::lock_guard<std::mutex> lock(mutex_);
      lost_.push_back(RedirectTo(room.name, room.holder.value_or(FleetHolder{"", "", room.epoch})));
      return Status::Ok();
    }
    if (mine && room.holder->epoch > held->second) {
      return TakeHere(room, room.holder->epoch, nullptr);
    }
    bool done = false;
    return room.holder ? Status::Ok() : directory_.TakeBack(room.name, held->second, &done);
  }
  const auto coming = coming_.find(room.name);
  if (coming != coming_.end() && mine) return Status::Ok();
  if (coming != coming_.end()) coming_.erase(coming);  // another was faster
  const auto failed = failed_.find(room.name);
  const bool tries = failed == failed_.end() || SteadyClockUs() > failed->second.again_us;
  if (!takes() || room.state.empty() || !tries) return Status::Ok();
  if (mine) {
    bool done = false;
    const Status status = directory_.TakeBack(room.name, room.holder->epoch, &done);
    if (!status.ok() || !done) return status;
    return TakeHere(room, room.holder->epoch,
                    watch_ != nullptr ? watch_->Take(room.name) : nullptr);
  }
  const auto used = static_cast<std::int32_t>(held_.size());
  if (room.holder || used >= config_.me.capacity || !IsOurs(room.name)) return Status::Ok();
  std::int32_t epoch = 0;
  const Status status = directory_.TakeOver(room.name, 1, &epoch);
  if (!status.ok() || epoch == 0) return status;
  return TakeHere(room, epoch, watch_ != nullptr ? watch_->Take(room.name) : nullptr);
}

Status FleetMember::TakeHere(const FleetRoom& room, std::int32_t epoch,
                             std::unique_ptr<FollowedRoom> followed) {
  try {
    RoomPlan plan = prepare_(room.name, epoch, std::move(followed));
    held_[room.name] = epoch;
    const std::lock_guard<std::mutex> lock(mutex_);
    ready_.push_back(std::move(plan));
  } catch (const OperatorError& error) {
    NoteUnopened({room.name, epoch, error.what()});
    return GiveUpUnopened();
  }
  return Status::Ok();
}

void FleetMember::GiveBack(const std::string& room, std::int32_t epoch, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  unopened_.push_back({room, epoch, why});
}

void FleetMember::NoteUnopened(const Unopened& failed) {
  const auto held = held_.find(failed.room);
  if (held != held_.end() && held->second > failed.epoch) return;  // it has come again since
  if (held != held_.end()) held_.erase(held);
  to_give_[failed.room] = failed.epoch;
  const std::int64_t now_us = SteadyClockUs();
  Failure& noted = failed_[failed.room];
  // It is tried as soon as it may be: long after, another server has had it in between.
  if (now_us > noted.again_us + kFailedMostUs) noted = Failure();
  noted.wait_us = std::min(std::max(kFailedUs, 2 * noted.wait_us), kFailedMostUs);
  noted.again_us = now_us + noted.wait_us;
  if (std::exchange(noted.why, failed.why) == failed.why) return;
  Say("room " + failed.room + " cannot go on here, its state stays: " + failed.why);
}

Status FleetMember::GiveUpUnopened() {
  std::vector<Unopened> unopened;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    unopened.swap(unopened_);
  }
  for (const Unopened& failed : unopened) NoteUnopened(failed);
  while (!to_give_.empty()) {
    const auto [room, epoch] = *to_give_.begin();
    const Status status = directory_.GiveUp(room, epoch);
    if (!status.ok()) return status;
    to_give_.erase(to_give_.begin());
  }
  return Status::Ok();
}

bool FleetMember::IsOurs(const std::string& room) const {
  return !ListSnapshots(config_.folder, room).empty();
}

void FleetMember::Release(const std::string& room) {
  const auto held = held_.find(room);
  if (held == held_.end()) return;
  (void)directory_.Release(room, held->second);
  held_.erase(held);
}

std::vector<RoomPlan> FleetMember::TakeReady() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<RoomPlan> next;
  if (ready_.empty()) return next;
  next.push_back(std::move(ready_.front()));
  ready_.erase(ready_.begin());
  return next;
}

std::vector<Redirect> FleetMember::TakeLost() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(lost_, {});
}

std::vector<std::string> FleetMember::TakeReports() {
  std::vector<std::string> news;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news = std::exchange(news_, {});
  }
  if (watch_ == nullptr) return news;
  for (std::string& line : watch_->TakeReports()) news.push_back(std::move(line));
  return news;
}

void FleetMember::Say(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.push_back(line);
}

}  // namespace seam
