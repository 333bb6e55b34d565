/// Server, inputs of players: taken, relayed; and rooms in which peers send inputs alone.

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/sync/rollback/replay.h"
#include "server/chronicle.h"
#include "server/input_room.h"
#include "server/server.h"

namespace seam {
namespace {

/// Inputs farther from now than this are dropped, s: no peer goes back farther, so that an action
/// cannot be decided after it mattered.
constexpr std::int64_t kInputReachS = kReplayMax;

}  // namespace

/// Returns the newest tick of which the inputs of all players here are known. A player counts as
/// absent after a second without inputs; at rest nothing depends on them.
std::int64_t Server::InputsKnownUntil() const {
  std::int64_t known = std::numeric_limits<std::int64_t>::max();
  if (!config_.sync.policy->SendsCompleteTicks() || replica_.rest().all()) return known;
  const std::vector<int>& peers = sessions_.PeerOfPlayer();
  for (std::size_t p = 0; p < peers.size(); ++p) {
    const std::int64_t newest = replica_.inputs(static_cast<int>(p)).newest();
    if (peers[p] > 0 && newest >= replica_.tick() - config_.sync.tick_hz) {
      known = std::min(known, newest);
    }
  }
  return known;
}

/// Stores the inputs of a message. Returns those from its first to its last tick that was not known
/// before, with the values known now.
Inputs Server::TakeFresh(std::int64_t now_us, const Inputs& inputs) {
  const InputTrack& track = replica_.inputs(inputs.player);
  std::int64_t from = inputs.first_tick;
  std::int64_t to = from + static_cast<std::int64_t>(inputs.drive.size());
  while (from < to && track.knows(from)) ++from;
  while (to > from && track.knows(to - 1)) --to;
  replica_.RecordInputs(inputs);
  Inputs fresh;
  fresh.utime = now_us;
  fresh.player = inputs.player;
  fresh.first_tick = from;
  for (std::int64_t tick = from; tick < to; ++tick) {
    const Input input = track.At(tick);
    fresh.drive.push_back(input.drive);
    fresh.lift.push_back(input.lift);
    fresh.buttons.push_back(input.buttons);
  }
  return fresh;
}

void Server::OnPacked(std::int64_t now_us, Session& session, const PackedInputs& packed) {
  const std::optional<std::vector<Inputs>> all = UnpackInputs(packed);
  if (!all) {
    ++stats_.counters.dropped_malformed;
    return;
  }
  for (const Inputs& inputs : *all) OnInputs(now_us, session, inputs);
}

void Server::OnInputs(std::int64_t now_us, Session& session, const Inputs& inputs) {
  const bool ready = session.stage == SessionStage::kReady;
  if (!ready || session.player < 0 || inputs.player != session.player) {
    ++stats_.counters.dropped_right;
    return;
  }
  const auto last = inputs.first_tick + static_cast<std::int64_t>(inputs.drive.size()) - 1;
  const std::int64_t reach = kInputReachS * scene_.solver.tick_hz;
  if (last < replica_.tick() - reach || inputs.first_tick > replica_.tick() + reach) {
    ++stats_.counters.dropped_stale;
    return;
  }
  const Inputs fresh = TakeFresh(now_us, inputs);
  if (fresh.drive.empty()) return;
  inputs_due_.push_back(inputs.player);
  if (input_room_ != nullptr) input_room_->NoteArrived(now_us, fresh);
  broadcast_.Publish(fresh);
}

/// Relays inputs in the call in which they came, before the flush at its end. Once a tick checks
/// all players that each client hears, or always where peers wait for each input; between ticks
/// only players with new inputs, or with inputs that wait to go along with another message.
void Server::RelayInputs(std::int64_t now_us) {
  const bool ticked = std::exchange(inputs_due_tick_, replica_.tick()) != replica_.tick();
  const bool stepped = ticked || input_room_ != nullptr;
  std::sort(inputs_due_.begin(), inputs_due_.end());
  inputs_due_.erase(std::unique(inputs_due_.begin(), inputs_due_.end()), inputs_due_.end());
  newest_inputs_.resize(scene_.players.size());
  for (const int p : inputs_due_) newest_inputs_[static_cast<std::size_t>(p)].drive.clear();
  if (input_room_ != nullptr) {  // it writes some
    for (Inputs& newest : newest_inputs_) newest.drive.clear();
  }
  for (const int p : inputs_due_) {  // ascending, and so are the sessions' lists
    if (stepped || static_cast<std::size_t>(p) >= hearers_.size()) break;
    for (const int peer : hearers_[static_cast<std::size_t>(p)]) {
      Session* const session = sessions_.Find(peer);
      const bool ready = session != nullptr && session->stage == SessionStage::kReady;
      if (ready) session->due_players.push_back(p);
    }
  }
  inputs_due_.clear();
  sessions_.ForEachReady(0, [&](Session& session) {
    session.feeds.resize(scene_.players.size());
    if (stepped) {
      RelayInputs(now_us, session.relevant_players, session);
      return;
    }
    std::vector<int>& players = session.due_players;
    const std::vector<int>& unsent = session.unsent_players;
    if (players.empty() && (unsent.empty() || !session.link.Sends(now_us))) return;
    const auto due = static_cast<std::ptrdiff_t>(players.size());
    players.insert(players.end(), unsent.begin(), unsent.end());
    std::inplace_merge(players.begin(), players.begin() + due, players.end());
    players.erase(std::unique(players.begin(), players.end()), players.end());
    RelayInputs(now_us, players, session);
    players.clear();
  });
}

/// Relays the inputs of these players, ascending, to one session.
void Server::RelayInputs(std::int64_t now_us, const std::vector<int>& players, Session& session) {
  const auto send = [&] {
    if (!inputs_packer_.empty()) {
      session.link.SendUnreliable(Encode(inputs_packer_.Finish()), input_receipts_);
    }
    input_receipts_.clear();
  };
  if (!session.send_queue.Ready(now_us)) {
    session.unsent_players = std::vector<int>(players);
    return;
  }
  bool rides = session.link.Sends(now_us);
  session.unsent_players.clear();
  for (const int p : players) {
    const InputTrack& track = replica_.inputs(p);
    if (track.newest() < 0) continue;
    InputFeed& feed = session.feeds[static_cast<std::size_t>(p)];
    const std::int64_t acked = session.link.acked(p);
    const bool all = input_room_ != nullptr;
    const int count = all ? feed.TakeAll(track, acked, now_us)
                          : feed.Take(track, acked, replica_.tick(), now_us, rides);
    if (count > 0) {
      Inputs& newest = newest_inputs_[static_cast<std::size_t>(p)];
      const int most = all ? static_cast<int>(kInputsMax) : kInputsRedundant;
      if (newest.drive.empty()) track.Export(p, most, &newest);
      if (!inputs_packer_.Add(newest, static_cast<std::size_t>(count))) {
        send();
        inputs_packer_.Add(newest, static_cast<std::size_t>(count));
      }
      input_receipts_.push_back({p, track.newest()});
      rides = true;
    } else if (feed.Waits(track)) {
      session.unsent_players.push_back(p);
    }
  }
  send();
}

/// Computes the players with inputs relevant to each client. To be called after authority or
/// relevance has changed.
void Server::FindRelevantPlayers() {
  sessions_.ForEachReady(0, [](Session& session) {
    session.relevant_players.clear();
    session.unsent_players.clear();  // the next tick checks all
  });
  hearers_.assign(scene_.players.size(), {});
  const Drivers& drivers = replica_.drivers();
  for (int p = 0; p < static_cast<int>(scene_.players.size()); ++p) {
    const auto hears = [&](Session& session) {
      std::vector<int>& heard = session.relevant_players;
      if (session.player == p || (!heard.empty() && heard.back() == p)) return;
      heard.push_back(p);
      hearers_[static_cast<std::size_t>(p)].push_back(session.peer);
    };
    if (drivers.MovesBelt(p) || input_room_ != nullptr) {
      sessions_.ForEachReady(0, hears);
      continue;
    }
    for (const int m : drivers.MechanismsOf(p)) {
      broadcast_.EachSimulating(m, hears);
    }
  }
}

/// Runs before the ticks that are due.
void Server::RunInputRoom(std::int64_t now_us) {
  input_room_->GiveWorlds(now_us, *edits_);
  if (!started()) return;
  input_room_->NoteDue(now_us, clock_);
  input_room_->WriteAbsent(now_us);
  const std::optional<int> ticks = input_room_->ChooseDelay();
  if (!ticks) return;
  Event event = MakeEvent(EventKind::kControl,
                          "inputs act " + std::to_string(*ticks) + " ticks after they are read");
  event.index = kMetaInputDelay;
  event.value_milli = 1000 * *ticks;
  chronicle_->Say(now_us, event);
  settings_.Adapt(*ticks);
  input_room_->NoteDelay(*ticks);
}

/// A client whose world has parted cannot be helped: worlds agree only by having been the same.
void Server::FindParted(std::int64_t now_us, Session& session, const Ping& ping) {
  if (session.leaving || !input_room_->HasParted(ping)) return;
  input_room_->NoteParted();
  Event event = MakeEvent(EventKind::kParted,
                          session.name + " (peer " + std::to_string(session.peer) +
                              ") has another world at tick " + std::to_string(ping.rest_part),
                          session.player);
  event.client = session.peer;
  chronicle_->Say(now_us, event);
  sessions_.Leave(session, "its world differs from the room's");
}

}  // namespace seam
