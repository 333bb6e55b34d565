#include "server/relay/relay.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/codec/packed/packed_inputs.h"
#include "common/sync/inputs/input_feed.h"
#include "common/sync/lease.h"
#include "common/sync/method.h"
#include "server/interest/late.h"
#include "server/server.h"

namespace seam {
namespace {

/// Ticks for which the newest inputs of a player are repeated: nothing acknowledges them, and a
/// burst of losses may take several.
constexpr std::int64_t kInputsRepeatTicks = 6;

/// Returns the reason for which a room of this mode cannot be passed on, or "".
std::string NotRelayed(const Room& room) {
  const SyncConfig sync = MakeSyncConfig(MethodNames{room.mode, room.reconcile, room.predict});
  if (sync.policy->SendsStates()) return "";
  return "the room is of mode " + room.mode +
         ", in which no states are sent: a relay has nothing to pass on; watch it at its server";
}

}  // namespace

Relay::Relay(const RelayConfig& config, Net& upstream, Net& downstream, Entropy& entropy)
    : play_at_(config.play_at),
      watchers_(downstream, entropy, config.limits, config.identity, config.token_key),
      downstream_(downstream),
      client_(Upstream(config.upstream), upstream, silent_, entropy) {}

ClientConfig Relay::Upstream(const ClientConfig& config) {
  ClientConfig upstream = config;
  upstream.watch = true;
  upstream.drive = Drive::kNone;
  upstream.publish = Publish::kNone;
  upstream.shows = true;  // bodies far from all players, too, are where watchers see them
  upstream.tap = this;
  return upstream;
}

std::string Relay::PlayAt() const {
  return play_at_.empty() ? ToString(client_.server()) : play_at_;
}

void Relay::Tick(std::int64_t now_us) {
  const auto tick_of = [this] {
    return client_.replica() != nullptr ? client_.replica()->tick() : -1;
  };
  const std::int64_t before = tick_of();
  client_.Tick(now_us, 0);
  downstream_.Advance(now_us);
  if (!fatal().empty() || closed()) return;
  const auto deliver = [&](Watcher& watcher, ByteView bytes) { Deliver(now_us, watcher, bytes); };
  watchers_.ReceiveAll(now_us, deliver);
  watchers_.DropSilent(now_us);
  const auto loaded = [&](Watcher& watcher) { SendWorld(now_us, watcher); };
  if (watchers_.has_room()) watchers_.Advance(now_us, Serves(now_us), loaded);
  const bool stepped = tick_of() != before;
  if (states_ && client_.replica() != nullptr) {
    if (stepped || StatesDue(now_us)) SendStates(now_us);
    if (stepped) SendInputs();
    if (stepped) TellQuiet();
  }
  watchers_.Flush(now_us);
}

void Relay::Shutdown(std::int64_t now_us, const std::string& reason) {
  client_.Shutdown(now_us);
  watchers_.Close(now_us, reason);
}

void Relay::OnRoom() {
  const Room& room = client_.room();
  refusal_ = NotRelayed(room);
  if (!refusal_.empty()) return;
  scene_ = std::make_shared<const Scene>(client_.replica()->world().scene());
  states_.emplace(PackedMotion(scene_->gravity.x(), scene_->gravity.y(), scene_->solver.tick_hz));
  edits_.emplace(*scene_);
  inputs_told_.assign(scene_->players.size(), -1);
  inputs_until_.assign(scene_->players.size(), -1);
  watchers_.SetRoom({room, scene_.get(), client_.peer(), client_.epoch()}, PlayAt());
}

void Relay::OnMessage(const AnyMessage& message, ByteView bytes) {
  if (!edits_ || client_.replica() == nullptr) return;
  bool urgent = false;
  if (const auto* order = std::get_if<EditOrder>(&message)) {
    edits_->Take(*order);
  } else if (const auto* snapshot = std::get_if<Snapshot>(&message)) {
    edits_->Take(*snapshot);
  } else if (std::holds_alternative<Grants>(message)) {
    urgent = true;
  } else if (!std::holds_alternative<Meta>(message) && !std::holds_alternative<Rest>(message) &&
             !std::holds_alternative<Event>(message)) {
    return;
  }
  watchers_.SendToAll(Bytes(bytes.begin(), bytes.end()), urgent);
}

void Relay::OnStates(const States& states) {
  if (states_ && client_.replica() != nullptr) states_->Add(states);
}

bool Relay::Serves(std::int64_t now_us) {
  if (client_.replica() == nullptr || edits_->incomplete()) return false;
  if (client_.running() || client_.waits_for_start()) return true;
  return client_.RoomUs(now_us).value_or(0) < 0;
}

void Relay::Deliver(std::int64_t now_us, Watcher& watcher, ByteView bytes) {
  const AnyMessage any = Decode(bytes);
  if (const auto* ping = std::get_if<Ping>(&any)) {
    OnPing(now_us, watcher, *ping);
  } else if (std::holds_alternative<Ready>(any)) {
    if (watchers_.NoteReady(watcher)) SendBodies(now_us, watcher);
  } else if (std::holds_alternative<Hello>(any)) {
    OnHello(now_us, watcher);
  } else if (std::holds_alternative<Bye>(any)) {
    watcher.leaving = true;
  } else {
    ++watchers_.stats().dropped_right;
  }
}

/// A client asks so for the players' names, as its own is none of them.
void Relay::OnHello(std::int64_t now_us, Watcher& watcher) {
  Bye bye;
  bye.utime = now_us;
  bye.reason = "this relay takes watchers alone, play at " + PlayAt();
  watchers_.SendTo(watcher, Encode(bye));
}

void Relay::OnPing(std::int64_t now_us, Watcher& watcher, const Ping& ping) {
  Pong pong;
  pong.utime = now_us;
  pong.client_us = ping.utime;
  pong.tick0_us = -1;
  if (const std::optional<std::int64_t> room_us = client_.RoomUs(now_us)) {
    // A server may say anything of its clock.
    pong.tick0_us = now_us - std::clamp(*room_us, now_us - kTimeMaxUs + 1, now_us + 1);
    pong.speed_ppm = client_.speed_ppm();
  }
  if (client_.replica() != nullptr) LookAtRest(now_us, watcher, ping, &pong);
  watcher.link.SendUnreliable(Encode(pong));
  const bool more = watcher.link.reliable_pending();
  if (watcher.stage != SessionStage::kReady || !Serves(now_us)) return;
  if (!edits_->NeedsRepair(ping, more)) return;
  // Not again too soon: the messages of the last repair must arrive first.
  if (now_us - watcher.repaired_us < Server::kRepairAgainUs) return;
  watcher.repaired_us = now_us;
  watchers_.SendTo(watcher, Encode(RelayedEdits::BeginAnew(now_us, client_.replica()->tick())));
  SendWorld(now_us, watcher);
}

void Relay::LookAtRest(std::int64_t now_us, Watcher& watcher, const Ping& ping, Pong* pong) {
  const Replica& replica = *client_.replica();
  const RestCommit& rest = replica.rest();
  pong->rest = static_cast<std::int64_t>(rest.Hash());
  watcher.rest_agrees = pong->rest == ping.rest;
  const bool same_bodies =
      ping.revision == replica.revision() &&
      ping.composition == static_cast<std::int64_t>(replica.world().composition().hash);
  const RestBlock at{ping.rest_blocks, ping.rest_block};
  if (watcher.stage != SessionStage::kReady || at.blocks == 0 || !same_bodies) return;
  pong->rest_blocks = ping.rest_blocks;
  pong->rest_block = ping.rest_block;
  pong->rest_own = static_cast<std::int32_t>(rest.HashOf(at, client_.peer()));
  const auto theirs = static_cast<std::uint32_t>(ping.rest_part);
  if (!watcher.rest.Lost(now_us, watcher.link.SentUntilUs(now_us), at, rest.HashOf(at, -1), theirs))
    return;
  for (Rest& again : rest.Again(at, -1)) {
    again.utime = now_us;
    watchers_.SendTo(watcher, Encode(again));
  }
}

void Relay::SendWorld(std::int64_t now_us, Watcher& watcher) {
  const auto send = [&](auto messages) {
    for (auto& message : messages) {
      message.utime = now_us;
      watchers_.SendTo(watcher, Encode(message));
    }
  };
  const std::vector<Snapshot> edits = edits_->History(now_us);
  // Half a world would be another world: a watcher that cannot be sent all of it has to leave.
  if (edits.size() > static_cast<std::size_t>(kSnapshotPartsMax)) watcher.leaving = true;
  send(edits);
  const Replica& replica = *client_.replica();
  const AuthorityTable& table = replica.authority();
  std::vector<int> all(static_cast<std::size_t>(table.count()));
  std::iota(all.begin(), all.end(), 0);
  send(table.Export(now_us, replica.tick(), all));
  SendBodies(now_us, watcher);
  send(client_.metadata().Export(now_us, replica.tick()));
}

void Relay::SendBodies(std::int64_t now_us, Watcher& watcher) {
  if (!client_.running()) return;  // bodies are where the scene has them
  const Replica& replica = *client_.replica();
  for (States& states : replica.Everything()) {
    states.utime = now_us;
    states.peer = 0;  // as the server would say it
    watchers_.SendTo(watcher, Encode(states));
  }
  for (Rest& rest : replica.rest().Everything()) {
    rest.utime = now_us;
    watchers_.SendTo(watcher, Encode(rest));
  }
}

/// Twice a tick at most: states come from each client at another time, and a datagram to each
/// watcher for each of them would be mostly headers.
bool Relay::StatesDue(std::int64_t now_us) const {
  return !states_->empty() && now_us - states_sent_us_ >= 500000 / client_.room().tick_hz;
}

void Relay::SendStates(std::int64_t now_us) {
  states_sent_us_ = now_us;
  const std::vector<SharedStates::Message> messages = states_->Take(now_us);
  composed_ += static_cast<std::int64_t>(messages.size());
  watchers_.EachReady([&](Watcher& watcher) { SendStatesTo(now_us, messages, watcher); });
}

void Relay::SendStatesTo(std::int64_t now_us, const std::vector<SharedStates::Message>& messages,
                         Watcher& watcher) {
  const auto send = [&](const SharedStates::Message& message) {
    watcher.link.SendUnreliable(message.bytes, {{kListedSlot, message.number}});
    watcher.states.NoteSent(message.number, now_us);
  };
  const bool carries = watchers_.Carries(now_us, watcher);
  for (const SharedStates::Message& message : messages) {
    if (carries) {
      send(message);
    } else {
      watcher.states.NoteLeftOut(message.number);
    }
  }
  // A silent watcher acknowledges nothing either.
  if (!carries || now_us - watcher.link.last_receive_us() > kSilentUs) return;
  const std::int64_t late_us = LateUs(watcher.link.rtt_us());
  const std::vector<std::int32_t> lost = watcher.states.TakeLost(now_us, late_us, *states_);
  if (lost.empty()) return;
  for (const SharedStates::Message& message : states_->Again(now_us, lost)) {
    ++composed_again_;
    send(message);
  }
}

void Relay::SendInputs() {
  const Replica& replica = *client_.replica();
  std::vector<Bytes> messages;
  InputsPacker packer;
  for (std::size_t p = 0; p < inputs_told_.size(); ++p) {
    const InputTrack& track = replica.inputs(static_cast<int>(p));
    if (track.newest() > inputs_told_[p]) {
      inputs_told_[p] = track.newest();
      inputs_until_[p] = replica.tick() + kInputsRepeatTicks;
    }
    if (replica.tick() > inputs_until_[p]) continue;
    const Inputs newest = track.Export(static_cast<int>(p), kInputsRedundant);
    if (newest.drive.empty()) continue;
    if (packer.Add(newest)) continue;
    messages.push_back(Encode(packer.Finish()));
    packer.Add(newest);
  }
  if (!packer.empty()) messages.push_back(Encode(packer.Finish()));
  if (messages.empty()) return;
  watchers_.EachReady([&](Watcher& watcher) {
    for (const Bytes& message : messages) watcher.link.SendUnreliable(message);
  });
}

void Relay::TellQuiet() {
  const bool quiet = client_.replica()->rest().all();
  watchers_.EachReady(
      [&](Watcher& watcher) { watcher.link.SetQuiet(quiet && watcher.rest_agrees); });
}

}  // namespace seam
