#include "server/fleet/standby_watch.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/record/segments/log_segments.h"

namespace seam {
namespace {

/// A room that was due and was not taken is due again after this, us.
constexpr std::int64_t kDueAgainUs = 1000000;

}  // namespace

bool LogPulse::Beats() {
  struct stat file = {};
  while (stat(SegmentPath(log_, segment_ + 1).c_str(), &file) == 0) ++segment_;
  if (stat(SegmentPath(log_, segment_).c_str(), &file) != 0) return false;
  const bool same = file.st_size == bytes_ && file.st_mtim.tv_sec == written_.tv_sec &&
                    file.st_mtim.tv_nsec == written_.tv_nsec;
  const bool first = bytes_ < 0;
  bytes_ = file.st_size;
  written_ = file.st_mtim;
  return !same && !first;
}

StandbyWatch::StandbyWatch(Config config) : config_(std::move(config)) {
  thread_ = std::thread([this] { Run(); });
}

StandbyWatch::~StandbyWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    wake_.notify_all();
  }
  thread_.join();
}

void StandbyWatch::Set(const std::vector<Guarded>& rooms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_ = rooms;
}

void StandbyWatch::Await(const std::string& room, std::int32_t epoch) {
  const std::lock_guard<std::mutex> lock(mutex_);
  taken_[room] = epoch;
  offers_ = false;
}

void StandbyWatch::NoteKnock(const std::string& room, const std::string& name, std::uint64_t key) {
  const std::int64_t now_us = SteadyClockUs();
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Knock>& all = heard_[room];
  for (Knock& knock : all) {
    if (knock.name == name && knock.key == key) {
      knock.at_us = now_us;
      return;
    }
  }
  if (all.size() >= kKnocksMax) all.erase(all.begin());
  all.push_back({name, key, now_us});
}

std::vector<StandbyWatch::Due> StandbyWatch::TakeDue() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(due_, {});
}

std::unique_ptr<FollowedRoom> StandbyWatch::Take(const std::string& room) {
  const std::lock_guard<std::mutex> lock(work_mutex_);
  const auto found = watched_.find(room);
  return found == watched_.end() ? nullptr : std::move(found->second.followed);
}

std::map<std::string, std::int64_t> StandbyWatch::Behind() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return behind_;
}

std::vector<std::string> StandbyWatch::TakeReports() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(news_, {});
}

void StandbyWatch::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  std::int64_t round_us = INT64_MIN / 2;  // begin of the last one
  while (!stop_) {
    const auto wanted = std::exchange(wanted_, std::nullopt);
    auto heard = std::exchange(heard_, {});
    const auto taken = std::exchange(taken_, {});
    lock.unlock();
    bool soon = false;
    {
      const std::lock_guard<std::mutex> work(work_mutex_);
      NoteTaken(taken);
      if (wanted) Adopt(*wanted);
      for (auto& [name, watched] : watched_) {
        for (Knock& knock : heard[name]) watched.knocks.push_back(std::move(knock));
        soon = soon || ((watched.leaving || watched.taken > 0) && !watched.given);
      }
      if (soon) LookAtLeaving();
      std::int64_t looked_us = SteadyClockUs();
      const bool round = looked_us - round_us >= kRoundUs;
      if (round) round_us = looked_us;
      for (auto& [name, watched] : watched_) {
        if (!round) break;
        Look(watched);
        if (soon) LookAtLeaving();
        // What one room takes must not look like a pause of this server to the others.
        if (SteadyClockUs() - looked_us < kRoundUs) continue;
        looked_us = SteadyClockUs();
        for (auto& [other, each] : watched_) LookAtHolder(each);
      }
    }
    lock.lock();
    wake_.wait_for(lock, std::chrono::microseconds(soon ? kSoonUs : kRoundUs),
                   [this] { return stop_; });
  }
}

void StandbyWatch::NoteTaken(const std::map<std::string, std::int32_t>& taken) {
  for (const auto& [room, epoch] : taken) {
    const auto found = watched_.find(room);
    if (found == watched_.end()) continue;
    found->second.taken = epoch;
    if (epoch == 0) found->second.due_again_us = SteadyClockUs() + kDueAgainUs;
  }
}

void StandbyWatch::Adopt(const std::vector<Guarded>& rooms) {
  std::map<std::string, Watched> before = std::exchange(watched_, {});
  for (auto& [name, watched] : before) {
    if (watched.taken > 0 && !watched.given) watched_[name] = std::move(watched);
  }
  for (const auto& [room, leaving] : rooms) {
    if (watched_.count(room.name) > 0) continue;
    const auto known = before.find(room.name);
    const bool same = known != before.end() && known->second.room.epoch == room.epoch;
    Watched& watched = watched_[room.name];
    if (same) watched = std::move(known->second);
    // It has held it again: it lives.
    if (same && watched.room.holder_changed != room.holder_changed) {
      watched.rule.NoteAlive(SteadyClockUs());
    }
    watched.room = room;
    watched.leaving = leaving;
    if (!same) watched.pulse = LogPulse(StateLogOf(config_.folder, room.name, room.epoch));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  behind_.clear();
  for (const auto& [name, watched] : watched_) behind_[name] = BehindOf(watched);
}

std::int64_t StandbyWatch::BehindOf(const Watched& watched) {
  return watched.followed == nullptr ? -1 : watched.followed->behind();
}

void StandbyWatch::LookAtHolder(Watched& watched) {
  const std::int64_t cpu_us = ThreadCpuUs();
  watched.rule.NoteLook(SteadyClockUs(), watched.pulse.Beats(), cpu_us - watched.worked_us);
  watched.worked_us = cpu_us;
}

void StandbyWatch::Look(Watched& watched) {
  LookAtHolder(watched);
  if (watched.taken > 0) return;
  std::int64_t now_us = SteadyClockUs();
  std::vector<Knock>& knocks = watched.knocks;
  const auto old = [&](const Knock& knock) {
    return now_us - knock.at_us > TakeOverRule::kKnockCountsUs;
  };
  knocks.erase(std::remove_if(knocks.begin(), knocks.end(), old), knocks.end());
  if (now_us < watched.due_again_us) return;  // it is being taken over
  const bool silent = watched.rule.Silent(now_us) && !knocks.empty();
  const bool follows = config_.warm || watched.leaving || watched.followed != nullptr;
  if (follows || silent) Follow(now_us, silent, watched);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    behind_[watched.room.name] = BehindOf(watched);
  }
  if (!silent || watched.followed == nullptr || watched.followed->behind() > 0) return;
  LookAtHolder(watched);  // to open a room takes a while
  now_us = SteadyClockUs();
  const FollowedRoom& followed = *watched.followed;
  for (const Knock& knock : knocks) {
    const int player = followed.Player(knock.name, knock.key);
    if (player >= 0) watched.rule.NoteKnock(knock.at_us, player);
  }
  knocks.clear();
  if (!watched.rule.Due(now_us, followed.present())) return;
  watched.due_again_us = now_us + kDueAgainUs;
  Due due;
  due.room = watched.room;
  due.present = static_cast<int>(followed.present().size());
  due.knocking = watched.rule.Knocking(now_us, followed.present());
  due.followed = std::move(watched.followed);
  Give(std::move(due));
}

void StandbyWatch::Give(Due due) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    due_.push_back(std::move(due));
  }
  config_.due();
}

void StandbyWatch::LookAtLeaving() {
  std::map<std::string, std::int32_t> taken;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    taken = std::exchange(taken_, {});
  }
  NoteTaken(taken);
  Watched* next = nullptr;
  for (auto& [name, watched] : watched_) {
    if (watched.given) continue;
    if (watched.taken > 0) return LookAtAwaited(watched);
    const bool ready = watched.followed != nullptr && watched.followed->behind() == 0;
    if (watched.leaving && ready && next == nullptr) next = &watched;
  }
  if (next != nullptr) Offer(*next);
}

void StandbyWatch::Offer(Watched& watched) {
  if (SteadyClockUs() < watched.due_again_us) return;
  Due due;
  due.room = watched.room;
  due.leaving = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    // With an answer that was not noted yet it may be this room that was taken.
    if (!taken_.empty() || std::exchange(offers_, true)) return;
  }
  Give(std::move(due));
}

void StandbyWatch::LookAtAwaited(Watched& watched) {
  LookAtHolder(watched);
  const std::int64_t now_us = SteadyClockUs();
  const bool silent = watched.rule.Silent(now_us);
  if (watched.followed != nullptr) Follow(now_us, silent, watched);
  const bool ended = watched.followed != nullptr && watched.followed->ended();
  if (!ended && !silent) return;
  watched.given = true;
  Due due;
  due.room = watched.room;
  due.epoch = watched.taken;
  due.followed = std::move(watched.followed);
  Give(std::move(due));
}

void StandbyWatch::Follow(std::int64_t now_us, bool silent, Watched& watched) {
  Status status;
  try {
    if (watched.followed == nullptr) {
      if (now_us < watched.opened_us + (silent ? kDueAgainUs : kFollowAgainUs)) return;
      watched.opened_us = now_us;
      watched.followed = std::make_unique<FollowedRoom>(config_.folder, watched.room.name,
                                                        watched.room.epoch, config_.log_key);
    }
    status = watched.followed->Follow(now_us);
  } catch (const OperatorError& error) {
    status = Status::Error(error.what());
  }
  // One that is not warm is of no use once its holder lives.
  const bool waits = watched.leaving || watched.taken > 0;
  const bool idle = !config_.warm && !waits && !watched.rule.Silent(now_us);
  if (!status.ok() || idle) watched.followed = nullptr;
  if (idle) watched.opened_us = INT64_MIN / 2;
  if (status.ok() || std::exchange(watched.trouble, status.why()) == status.why()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.push_back("room " + watched.room.name + " is not followed now: " + status.why());
}

}  // namespace seam
