#include "server/saved/followed_room.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "common/base/check.h"
#include "common/base/entropy.h"
#include "common/base/process.h"
#include "common/net/memory.h"
#include "server/saved/trial_load.h"
#include "server/server.h"

namespace seam {

struct FollowedRoom::Quiet {
  struct Silence : Recorder {
    void Publish(const std::string&, std::int64_t, ByteView) override {}
    bool listening() const override { return false; }
  };
  Quiet(const SavedRoom& saved, const ServerConfig& config)
      : net(network.Attach({1, 1})), server(saved, config, *net, silence, entropy) {}

  MemoryNetwork network;
  std::unique_ptr<Net> net;
  Silence silence;
  OsEntropy entropy;
  Server server;
};

namespace {

ServerConfig Silent(const SavedRoom& saved) {
  ServerConfig config = ConfigOf(saved.room());
  config.publish = Publish::kNone;
  config.epoch = saved.epoch();
  return config;
}

/// Opens it; of an earlier epoch it is a room as it was before this server's.
NewestSnapshot Open(const std::string& folder, const std::string& room, std::int32_t epoch) {
  NewestSnapshot newest = OpenNewestSnapshot(folder, room);
  if (newest.epoch == epoch) return newest;
  throw OperatorError(folder + ": room " + room + " has no snapshot of epoch " +
                      std::to_string(epoch) + " that can be read");
}

/// True if the end of a room is among the messages.
bool HasEnd(const std::vector<AnyMessage>& messages) {
  return std::any_of(messages.begin(), messages.end(), [](const AnyMessage& any) {
    const auto* sum = std::get_if<Summary>(&any);
    return sum != nullptr && sum->of == sum->session &&
           sum->ended == static_cast<std::int8_t>(Ended::kEnded);
  });
}

}  // namespace

FollowedRoom::FollowedRoom(const std::string& folder, const std::string& room, std::int32_t epoch,
                           std::shared_ptr<const Secret> log_key)
    : folder_(folder), room_(room), log_key_(std::move(log_key)) {
  const NewestSnapshot newest = Open(folder, room, epoch);
  quiet_ = std::make_unique<Quiet>(*newest.saved, Silent(*newest.saved));
  const Status status = quiet_->server.Follow(*newest.saved, SteadyClockUs());
  if (!status.ok()) throw OperatorError(folder + ": " + status.why());
  log_ = std::make_unique<LogFollower>(StateLogOf(folder, room, epoch), room, newest.log,
                                       newest.tick, log_key_.get());
}

FollowedRoom::~FollowedRoom() = default;

std::int64_t FollowedRoom::tick() const { return quiet_->server.tick(); }

const std::vector<int>& FollowedRoom::present() const { return quiet_->server.replayed_present(); }

int FollowedRoom::Player(const std::string& name, std::uint64_t key) const {
  const auto& players = quiet_->server.scene().players;
  for (const int player : present()) {
    const bool named = players[static_cast<std::size_t>(player)].name == name;
    if (named && quiet_->server.places().IsOwner(name, key)) return player;
  }
  return -1;
}

Status FollowedRoom::Read(std::int64_t now_us) {
  LogTail tail;
  const Status status = log_->Read(&tail);
  if (!status.ok()) return status;
  // Behind the last tick: its own, if the tick had nothing else.
  if (!tail.ticks.empty()) ended_ = HasEnd(tail.ticks.back().after);
  ended_ = ended_ || HasEnd(tail.begun);
  pending_.insert(pending_.end(), std::make_move_iterator(tail.ticks.begin()),
                  std::make_move_iterator(tail.ticks.end()));
  begun_ = std::move(tail.begun);
  if (tail.summary) summary_ = tail.summary;
  if (tail.damage.empty()) {
    damaged_us_ = -1;
  } else if (damaged_us_ < 0) {
    damaged_us_ = now_us;
  } else if (now_us - damaged_us_ >= kDamagedUs) {
    return Status::Error(tail.damage);
  }
  return Status::Ok();
}

Status FollowedRoom::DoOne(std::int64_t now_us) {
  Server& server = quiet_->server;
  const TickMessages tick = std::move(pending_.front());
  pending_.pop_front();
  server.Replay(now_us, tick);
  const auto hash = static_cast<std::uint16_t>(server.replica().world().Hash());
  if (!tick.hash || hash == *tick.hash) return Status::Ok();
  return Status::Error("tick " + std::to_string(tick.tick) +
                       " comes out otherwise than in the log");
}

Status FollowedRoom::Follow(std::int64_t now_us) {
  Status status = Read(now_us);
  const auto most = static_cast<std::size_t>(kFollowBehindS * quiet_->server.room().tick_hz);
  if (status.ok() && pending_.size() > most) {
    status = Status::Error("it is " + std::to_string(pending_.size()) + " ticks behind");
  }
  const std::int64_t until_us = ThreadCpuUs() + kWorkUs;
  while (status.ok() && !pending_.empty() && ThreadCpuUs() < until_us) status = DoOne(now_us);
  return status;
}

std::shared_ptr<ResumedRoom> FollowedRoom::Finish(std::int64_t now_us, std::int32_t epoch) {
  Status status = Read(now_us);
  while (status.ok() && !pending_.empty()) status = DoOne(now_us);
  auto resumed = std::make_shared<ResumedRoom>();
  Server& server = quiet_->server;
  // They were there until now: their places wait for them from now on.
  PlaceTable& places = server.places();
  for (int peer = 1; peer < kPeersMax; ++peer) {
    const int player = places.at(peer).player;
    const bool there = player < 0 || std::count(present().begin(), present().end(), player) > 0;
    if (there) places.NoteBack(peer, now_us);
  }
  if (status.ok()) resumed->saved = SavedRoom::Read(server.Save(now_us), &status);
  if (!status.ok()) throw OperatorError(folder_ + ": room " + room_ + ": " + status.why());
  resumed->epoch = epoch;
  resumed->saved_tick = server.tick();
  resumed->tail.present = present();
  resumed->tail.begun = std::move(begun_);
  resumed->tail.summary = summary_;
  resumed->log = StateLogOf(folder_, room_, epoch);
  resumed->new_log = true;
  return resumed;
}

}  // namespace seam
