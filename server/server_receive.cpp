/// Server, incoming: every byte is distrusted; what fails is dropped and counted by reason.

#include <cmath>
#include <cstdlib>

#include "common/codec/codec.h"
#include "server/rules/rules.h"
#include "server/server.h"

namespace seam {
namespace {

/// Inputs this far from now are nonsense, ticks.
constexpr std::int64_t kInputTicksMax = 600;
/// States this far in the past or future are nonsense, s.
constexpr double kStatesPast = 2.0;
constexpr double kStatesFuture = 0.5;
/// A body may move this much more than its speed explains between two states, m: a hard correction.
constexpr float kJumpSlack = 5.0f;
/// Sessions that have not proved their address, at most: more are refused until some time out.
constexpr std::size_t kSessionsMax = 64;

}  // namespace

void Server::ReceiveAll(std::int64_t now_us) {
  Address from;
  Bytes datagram;
  // Bounded: a flood must not keep the room from stepping.
  for (int n = 0; n < 4096 && net_.Receive(&from, &datagram); ++n) {
    stats_.bytes_in += static_cast<std::int64_t>(datagram.size());
    stats_.datagrams_in += 1;
    OnDatagram(now_us, from, datagram);
  }
  stats_.dropped_malformed += net_.discarded() - discarded_;
  discarded_ = net_.discarded();
}

void Server::OnDatagram(std::int64_t now_us, const Address& from, const Bytes& datagram) {
  const std::uint64_t number = PeekSession(datagram);
  if (number == 0) {
    ++stats_.dropped_malformed;
    return;
  }
  auto found = sessions_.find(from);
  if (found != sessions_.end() && found->second->number != number) {
    // A restarted client on the same port: its old self is gone, if it has been quiet for a while.
    if (now_us - found->second->link.last_receive_us() < 500000) {
      ++stats_.dropped_right;
      return;
    }
    Drop(now_us, from, "came back with a new session");
    found = sessions_.end();
  }
  if (found != sessions_.end()) {
    Session& session = *found->second;
    const bool good = session.link.Receive(
        now_us, datagram, [&](ByteView message) { OnMessage(now_us, session, message); });
    if (!good) ++stats_.dropped_malformed;
    return;
  }
  if (sessions_.size() >= kSessionsMax && !EvictUnproven(now_us)) {
    ++stats_.dropped_right;
    return;
  }
  auto session = std::make_unique<Session>(number);
  session->address = from;
  session->created_us = now_us;
  bool greeted = false;
  const bool good = session->link.Receive(now_us, datagram, [&](ByteView message) {
    const AnyMessage any = Decode(message);
    const Hello* hello = std::get_if<Hello>(&any);
    if (hello == nullptr || greeted) return;
    greeted = true;
    OnHello(now_us, *session, *hello);
  });
  if (!good || !greeted) {
    ++stats_.dropped_malformed;
    return;
  }
  if (session->peer > 0) sessions_.emplace(from, std::move(session));
}

void Server::OnHello(std::int64_t now_us, Session& session, const Hello& hello) {
  if (session.peer > 0) {
    // Said again, reliably: loaded, and the clock has settled. Before that it only repeats itself.
    if (session.stage == SessionStage::kLoading) {
      session.stage = SessionStage::kReady;
      if (rules_ != nullptr && session.player >= 0) rules_->OnJoin(session.player);
      authority_.PlanSoon();
      Say(now_us, session.name + " is ready as peer " + std::to_string(session.peer));
    }
    return;
  }
  if (hello.protocol != kProtocolVersion) {
    Refuse(now_us, session.address, session.number,
           "protocol " + std::to_string(kProtocolVersion) + " is spoken here");
    return;
  }
  Admit(now_us, session, hello.name);
}

void Server::OnMessage(std::int64_t now_us, Session& session, ByteView bytes) {
  const AnyMessage any = Decode(bytes);
  if (const auto* states = std::get_if<States>(&any)) {
    OnStates(now_us, session, *states);
  } else if (const auto* inputs = std::get_if<Inputs>(&any)) {
    OnInputs(now_us, session, *inputs);
  } else if (const auto* ping = std::get_if<Ping>(&any)) {
    Pong pong;
    pong.utime = now_us;
    pong.client_us = ping->utime;
    pong.tick0_us = tick0_us_;
    session.link.SendUnreliable(Encode(pong));
    CheckComposition(now_us, session, *ping);
  } else if (const auto* proposal = std::get_if<EditOrder>(&any)) {
    OnProposal(session, *proposal);
  } else if (const auto* hello = std::get_if<Hello>(&any)) {
    OnHello(now_us, session, *hello);
  } else if (std::holds_alternative<Bye>(any)) {
    session.leaving = true;
    session.leaving_why = "left";
  } else {
    ++stats_.dropped_malformed;
  }
}

void Server::OnInputs(std::int64_t now_us, Session& session, const Inputs& inputs) {
  if (session.player < 0 || inputs.player != session.player) {
    ++stats_.dropped_right;
    return;
  }
  if (std::llabs(inputs.first_tick - replica_.tick()) > kInputTicksMax) {
    ++stats_.dropped_implausible;
    return;
  }
  InputTrack& track = replica_.inputs(session.player);
  Inputs fresh;
  fresh.utime = now_us;
  fresh.player = inputs.player;
  for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
    const std::int64_t tick = inputs.first_tick + static_cast<std::int64_t>(i);
    if (track.knows(tick)) continue;
    if (fresh.drive.empty()) fresh.first_tick = tick;
    // A gap inside one message would need two; redundancy makes it one run in practice.
    if (tick != fresh.first_tick + static_cast<std::int64_t>(fresh.drive.size())) break;
    fresh.drive.push_back(inputs.drive[i]);
    fresh.lift.push_back(inputs.lift[i]);
    fresh.buttons.push_back(inputs.buttons[i]);
  }
  if (fresh.drive.empty()) return;
  track.Note(fresh);
  publisher_.Publish(fresh);
  const Bytes bytes = Encode(inputs);
  for (auto& [address, other] : sessions_) {
    if (other->peer != session.peer && other->stage == SessionStage::kReady) {
      other->link.SendUnreliable(bytes);
    }
  }
}

bool Server::Plausible(int body, std::int64_t tick, const BodyState& state) {
  const Vec2& p = state.position;
  if ((p.array() < scene_.bounds_min.array()).any()) return false;
  if ((p.array() > scene_.bounds_max.array()).any()) return false;
  if (state.velocity.norm() > scene_.speed_limit) return false;
  const LastAccepted& last = accepted_[static_cast<std::size_t>(body)];
  if (last.tick < 0) return true;
  const float seconds =
      static_cast<float>(std::max<std::int64_t>(1, tick - last.tick)) * replica_.world().dt();
  return (p - last.position).norm() <= scene_.speed_limit * seconds + kJumpSlack;
}

void Server::OnStates(std::int64_t now_us, Session& session, const States& states) {
  const double hz = config_.sync.tick_hz;
  const auto age = static_cast<double>(replica_.tick() - states.tick);
  if (states.peer != session.peer || session.stage != SessionStage::kReady) {
    ++stats_.dropped_right;
    return;
  }
  if (age > kStatesPast * hz || age < -kStatesFuture * hz) {
    ++stats_.dropped_stale;
    return;
  }
  const auto hash = hash_after_.find(states.revision);
  const bool other =
      hash != hash_after_.end() && hash->second != static_cast<std::uint64_t>(states.composition);
  if (other || states.revision > replica_.revision()) {
    ++stats_.dropped_implausible;  // its next ping has it repaired
    return;
  }
  States kept;  // what is accepted of it
  kept.utime = now_us;
  kept.peer = states.peer;
  kept.tick = states.tick;
  kept.revision = states.revision;
  kept.composition = states.composition;
  kept.origin_x = states.origin_x;
  kept.origin_y = states.origin_y;
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(states.id[i]);
    if (body < 0) {
      ++(states.revision < replica_.revision() ? stats_.dropped_stale : stats_.dropped_right);
      continue;
    }
    if (!replica_.SameBody(body, states.revision)) {
      ++stats_.dropped_stale;
      continue;
    }
    const auto right = authority_.RightToMove(session.peer, body, states.epoch[i]);
    if (right != AuthorityManager::Right::kYes) {
      ++(right == AuthorityManager::Right::kStale ? stats_.dropped_stale : stats_.dropped_right);
      continue;
    }
    const BodyState state = Unpack(states, i, 0);
    if (!Plausible(body, states.tick, state)) {
      ++stats_.dropped_implausible;
      continue;
    }
    LastAccepted& last = accepted_[static_cast<std::size_t>(body)];
    if (states.tick > last.tick) last = {states.tick, state.position};
    kept.id.push_back(states.id[i]);
    kept.epoch.push_back(states.epoch[i]);
    kept.flags.push_back(states.flags[i]);
    kept.x.push_back(states.x[i]);
    kept.y.push_back(states.y[i]);
    kept.angle.push_back(states.angle[i]);
    kept.vx.push_back(states.vx[i]);
    kept.vy.push_back(states.vy[i]);
    kept.spin.push_back(states.spin[i]);
  }
  if (kept.id.empty()) return;
  stats_.dropped_stale += replica_.Receive(kept).stale;
  Relay(kept, session.peer);
  publisher_.Publish(kept);
}

}  // namespace seam
