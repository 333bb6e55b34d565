#include "server/server.h"

#include <algorithm>
#include <limits>

#include "common/sync/input_source.h"
#include "server/rules/rules.h"

namespace seam {
namespace {

/// Most ticks stepped in one call: a server that was suspended catches up without starving the net.
constexpr int kStepsMax = 8;
/// Remote mechanisms are relayed every so many sends.
constexpr std::int64_t kFarEvery = 3;

}  // namespace

Server::Server(const Scene& scene, const ServerConfig& config, Net& net, Recorder& recorder)
    : scene_(scene),
      config_(config),
      net_(net),
      publisher_(recorder, config.room),
      replica_(scene_, config.sync, 0, -1),
      authority_(scene_, config.sync, replica_) {
  hash_after_[0] = replica_.world().composition().hash;
  accepted_.resize(static_cast<std::size_t>(replica_.world().body_count()));
  MakeRules();
}

Server::~Server() = default;

void Server::Tick(std::int64_t now_us, std::int64_t cpu_us) {
  net_.Advance(now_us);
  ReceiveAll(now_us);
  DropSilent(now_us);
  for (auto& [address, session] : sessions_) Advance(now_us, *session);
  StartIfReady(now_us);
  if (now_us - last_room_us_ >= 1000000) {
    last_room_us_ = now_us;
    publisher_.Publish(MakeRoom(now_us));
  }
  for (int steps = 0; steps < kStepsMax && now_us >= next_tick_us(); ++steps) {
    worst_late_us_ = std::max(worst_late_us_, now_us - next_tick_us());
    StepOnce(now_us);
  }
  if (now_us - last_stats_us_ >= 1000000) PublishStats(now_us, cpu_us);
  FlushAll(now_us);
}

std::int64_t Server::next_tick_us() const {
  if (!started()) return std::numeric_limits<std::int64_t>::max();
  return tick0_us_ + (replica_.tick() + 1) * 1000000 / config_.sync.tick_hz;
}

void Server::StartIfReady(std::int64_t now_us) {
  if (started()) return;
  int ready = 0;
  for (const auto& [address, session] : sessions_) {
    if (session->stage == SessionStage::kReady && session->player >= 0) ++ready;
  }
  if (ready < config_.wait_players) return;
  tick0_us_ = now_us + (config_.wait_players > 0 ? kLeadInUs : 0);
  // Whoever is here from the start has its mechanisms from tick 0 on: plan once, now.
  UpdateAuthority(now_us);
  View view = replica_.MakeView();
  view.utime = now_us;
  publisher_.Publish(view);
  Say(now_us, "the room starts with " + std::to_string(ready) + " players");
}

void Server::StepOnce(std::int64_t now_us) {
  if (config_.sync.mode == Mode::kOracle) {
    for (std::size_t p = 0; p < scene_.players.size(); ++p) {
      Inputs inputs;
      inputs.utime = now_us;
      inputs.player = static_cast<int>(p);
      inputs.first_tick = replica_.tick() + 1;
      const Input in = ScriptedInput(scene_, inputs.player, inputs.first_tick);
      inputs.drive.push_back(in.drive);
      inputs.lift.push_back(in.lift);
      inputs.buttons.push_back(in.buttons);
      publisher_.Publish(inputs);
    }
  }
  OrderPending(now_us);
  replica_.Step();
  for (const Edit& edit : replica_.TakeProposals()) Order(edit);
  UpdateSeats();
  UpdateAuthority(now_us);
  for (States& states : replica_.TakeStates()) {
    states.utime = now_us;
    Relay(states, 0);
    publisher_.Publish(states);
  }
  View view = replica_.MakeView();
  view.utime = now_us;
  publisher_.Publish(view);
  Impacts impacts = replica_.MakeImpacts();
  impacts.utime = now_us;
  if (!impacts.id_a.empty()) publisher_.Publish(impacts);
  RunRules(now_us);
}

void Server::UpdateAuthority(std::int64_t now_us) {
  AuthorityManager::Situation situation;
  situation.peer_of_player = PeerOfPlayer();
  for (const auto& [address, session] : sessions_) {
    if (!session->link.reliable_pending()) situation.confirmed.Add(session->peer);
  }
  for (const Pending& pending : pending_) {
    situation.together.push_back(MechanismsOf(pending.edit));
  }
  Announce(authority_.Update(now_us, situation));
}

void Server::Announce(const std::vector<Grants>& messages) {
  for (const Grants& g : messages) {
    publisher_.Publish(g);
    SendToAll(Encode(g));
  }
}

void Server::SendToAll(const Bytes& message) {
  for (auto& [address, session] : sessions_) {
    if (session->stage == SessionStage::kGreeted || session->link.SendReliable(message)) continue;
    session->leaving = true;
    session->leaving_why = "does not acknowledge";
  }
}

void Server::Relay(const States& states, int from_peer) {
  const Bytes bytes = Encode(states);
  const std::int64_t send = states.tick / config_.sync.send_every();
  for (auto& [address, session] : sessions_) {
    if (session->peer == from_peer || session->stage != SessionStage::kReady) continue;
    bool near = config_.sync.mode != Mode::kBuffer;
    for (std::size_t i = 0; i < states.id.size() && !near; ++i) {
      const int body = replica_.world().BodyOfId(states.id[i]);
      if (body < 0) continue;  // it has left meanwhile
      near = authority_.Follows(session->peer, body);
    }
    if (near || send % kFarEvery == 0) session->link.SendUnreliable(bytes);
  }
}

void Server::Say(std::int64_t now_us, const std::string& text) {
  Event event;
  event.utime = now_us;
  event.tick = replica_.tick();
  event.text = text;
  publisher_.Publish(event);
}

void Server::PublishStats(std::int64_t now_us, std::int64_t cpu_us) {
  last_stats_us_ = now_us;
  stats_.utime = now_us;
  stats_.tick = replica_.tick();
  stats_.cpu_us = cpu_us;
  stats_.tick_late_us = static_cast<std::int32_t>(std::min<std::int64_t>(worst_late_us_, 1 << 30));
  worst_late_us_ = 0;
  stats_.rtt_us = -1;
  std::int64_t loss = 0;
  for (const auto& [address, session] : sessions_) {
    stats_.rtt_us = std::max(stats_.rtt_us, static_cast<std::int32_t>(session->link.rtt_us()));
    loss = std::max(loss, session->link.loss_ppm());
  }
  stats_.loss_ppm = static_cast<std::int32_t>(loss);
  publisher_.Publish(stats_);
}

Room Server::MakeRoom(std::int64_t utime) const {
  Room room;
  room.utime = utime;
  room.room = config_.room;
  room.scene_name = scene_.name;
  room.scene_text = scene_.text;
  room.mode = ToString(config_.sync.mode);
  room.reconcile = config_.sync.reconcile_name;
  room.impair = config_.impair;
  room.seed = config_.seed;
  room.tick_hz = config_.sync.tick_hz;
  room.send_hz = config_.sync.send_hz;
  return room;
}

}  // namespace seam
