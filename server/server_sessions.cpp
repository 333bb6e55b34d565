/// Server: effects of sessions that come and go, and the lines for people about them.

#include <algorithm>
#include <cmath>

#include "common/scene/forces.h"
#include "common/sync/lease.h"
#include "server/chronicle.h"
#include "server/console.h"
#include "server/input_room.h"
#include "server/rules/rules.h"
#include "server/server.h"

namespace seam {
namespace {

/// Most lines kept until TakeReports.
constexpr std::size_t kNewsMax = 256;

/// Returns a bit field of the player's buttons that drive a thrust, also from a seat.
int PushingButtons(const Scene& scene, int player) {
  const auto players = scene.players.size();
  int buttons = 0;
  for (const Thrust& thrust : scene.thrusts) {
    if (thrust.button < 0 || thrust.player < 0) continue;
    const auto who = static_cast<std::size_t>(thrust.player);
    const int driver = who < players ? thrust.player : scene.seats[who - players].player;
    if (driver == player) buttons |= 1 << thrust.button;
  }
  return buttons;
}

}  // namespace

bool Server::NotePlaces(std::int64_t now_us) {
  const std::vector<PlaceTable::Change> changes = sessions_.places().TakeChanges();
  for (const PlaceTable::Change& change : changes) {
    Join owner;
    owner.name = change.name;
    owner.token = static_cast<std::int64_t>(change.key_hash);
    owner.exchange.resize(kJoinExchangeBytes);
    broadcast_.NoteAccepted(now_us, change.peer, -1, owner);
  }
  return !changes.empty();
}

void Server::FollowSessions(std::int64_t now_us) {
  for (const SessionEvent& event : sessions_.TakeEvents()) {
    const std::string peer = "peer " + std::to_string(event.peer);
    const auto say = [&](EventKind kind, const std::string& text) {
      Event said = MakeEvent(kind, text, event.player);
      said.client = event.peer;
      chronicle_->Say(now_us, said);
    };
    switch (event.kind) {
      case SessionEvent::Kind::kJoined:
        sessions_.Find(event.peer)->kinds = KindBudget(config_.sync.send_hz, scene_.parts.size());
        say(EventKind::kConnected,
            event.name + " joins from " + ToString(event.address) + " as " + peer);
        break;
      case SessionEvent::Kind::kLoading: {
        Session& session = *sessions_.Find(event.peer);
        SendWorld(now_us, session);
        break;
      }
      case SessionEvent::Kind::kReady:
        SendBodies(now_us, *sessions_.Find(event.peer));
        if (input_room_ != nullptr) input_room_->NoteReady(event.peer);
        if (rules_ != nullptr && event.player >= 0) rules_->OnJoin(event.player);
        broadcast_.NoteAccepted(now_us, event.peer, event.player, Ready());
        authority_.PlanSoon();
        look_soon_ = true;
        broadcast_.NotePeerReady(event.peer);
        say(chronicle_->NoteReady(event.name) ? EventKind::kRejoined : EventKind::kJoined,
            event.name + " is ready as " + peer);
        Tell(event.name + " is here as " + peer + ", " + ToString(event.address));
        break;
      case SessionEvent::Kind::kLeft:
        if (event.was_ready) chronicle_->NoteLeft(event.name);
        say(EventKind::kLeft, event.name + " (" + peer + ") is gone: " + event.why);
        if (event.was_ready) Tell(event.name + " is gone: " + event.why);
        if (rules_ != nullptr && event.player >= 0 && event.was_ready) {
          rules_->OnLeave(event.player);
        }
        if (event.was_ready) broadcast_.NoteAccepted(now_us, event.peer, event.player, Bye());
        broadcast_.Tell(authority_.TakeBack(now_us, event.peer));
        NoteAuthority(now_us);
        if (event.player >= 0 && event.was_ready) LetGo(now_us, event.player, 0);
        if (event.player >= 0 && input_room_ != nullptr) input_room_->NoteLeft(event.player);
        break;
    }
  }
}

/// Ends the leases of clients that do not release a mechanism. Such a client may not have received
/// the request, and goes on as long as its pings are answered. So the server stops answering and
/// drops the client after kEndingUs; by then its lease has ended and it has released everything.
void Server::EndLeases(std::int64_t now_us) {
  const PeerSet withholding = authority_.OverdueHolders(now_us);
  sessions_.ForEachReady(0, [&](Session& session) {
    if (withholding.Has(session.peer) && session.ending_us < 0) {
      session.lapsed = true;
      session.ending_us = now_us;
    }
    if (session.ending_us < 0 || now_us - session.ending_us <= kEndingUs) return;
    if (session.player >= 0 && !session.leaving)
      ladder_.NoteWithheld(session.player, replica_.tick());
    sessions_.Leave(session, "does not let go");
  });
}

/// Releases the controls of drivers that are silent for kDriverSilentUs, until they are heard
/// again. Buttons that drive nothing stay pressed: otherwise going on would count as a new press.
void Server::ReleaseSilentDrivers(std::int64_t now_us) {
  if (now_us < drivers_heard_us_) return;
  drivers_heard_us_ = now_us + kDriverSilentUs;
  const std::vector<int>& peers = sessions_.PeerOfPlayer();
  for (std::size_t p = 0; p < peers.size(); ++p) {
    const Session* session = sessions_.Find(peers[p]);
    if (session == nullptr) continue;
    const std::int64_t heard_us = session->link.last_receive_us() + kDriverSilentUs;
    drivers_heard_us_ = std::min(drivers_heard_us_, heard_us + 1);
    if (now_us <= heard_us) continue;
    const int player = static_cast<int>(p);
    const InputTrack& track = replica_.inputs(player);
    const Input last = track.At(track.newest());
    const int pushing = PushingButtons(replica_.world().scene(), player);
    if (last.drive == 0 && last.lift == 0 && (last.buttons & pushing) == 0) continue;
    LetGo(now_us, player, static_cast<std::int16_t>(last.buttons & ~pushing));
  }
}

/// Adds an input without drive and lift: otherwise the player's last input would drive on for ever.
void Server::LetGo(std::int64_t now_us, int player, std::int16_t buttons) {
  const InputTrack& track = replica_.inputs(player);
  if (!config_.sync.policy->SendsStates() || track.newest() < 0) return;
  Inputs nothing;
  nothing.player = player;
  nothing.first_tick = std::max(track.newest(), replica_.tick()) + 1;
  nothing.drive.push_back(0);
  nothing.lift.push_back(0);
  nothing.buttons.push_back(buttons);
  inputs_due_.push_back(player);
  broadcast_.Publish(TakeFresh(now_us, nothing));
}

/// Adds a line of news: "bob is gone: left; 1 of 2 players, missing: bob".
void Server::Tell(const std::string& line) {
  if (news_.size() >= kNewsMax) return;
  std::string all = line + "; " + std::to_string(player_count()) + " of " +
                    std::to_string(scene_.players.size()) + " players";
  const std::string names = MissingPlayers(*this);
  if (!names.empty()) all += ", missing: " + names;
  news_.push_back(all);
}

std::vector<std::string> Server::missing() const {
  const std::vector<int>& peers = sessions_.PeerOfPlayer();
  std::vector<std::string> names;
  for (std::size_t p = 0; p < peers.size(); ++p) {
    if (peers[p] < 0) names.push_back(scene_.players[p].name);
  }
  return names;
}

/// Counts a correction of the server's copy of a body: for the client with authority over the body,
/// or, if the server has it, for the client of the player that owns the body.
void Server::NoteCorrected(int body, const BodyState& by) {
  stats_.connections.corrected.Add(std::llround(double{by.position.norm()} * 1e6));
  const int mechanism = replica_.world().mechanism(body);
  const int peer = replica_.authority().at(mechanism).authority;
  const auto& mechanisms = replica_.world().composition().mechanisms;
  const int owner = mechanisms[static_cast<std::size_t>(mechanism)].owner;
  const bool owned = peer == 0 && owner >= 0;
  const int of = owned ? sessions_.PeerOfPlayer()[static_cast<std::size_t>(owner)] : peer;
  Session* const session = of > 0 ? sessions_.Find(of) : nullptr;
  if (session != nullptr) ++session->account->corrections;
}

}  // namespace seam
