/// Server: players that enter or leave seats, and the bonds that follow.

#include <algorithm>
#include <cstdio>
#include <set>

#include "common/scene/forces.h"
#include "server/chronicle.h"
#include "server/rules/rules.h"
#include "server/rules/seats.h"
#include "server/server.h"

namespace seam {
namespace {

/// Least time between two refusals that a player is told, us: a button may be hammered.
constexpr std::int64_t kRefuseAgainUs = 1000000;

/// Returns "ann: no seat within reach; cab is 3.2 m away, its reach is 1.5 m" and the like.
std::string Describe(const Scene& scene, int player, const SeatRefusal& refused) {
  const Seat& seat = scene.seats[static_cast<std::size_t>(refused.seat)];
  const std::string name = scene.players[static_cast<std::size_t>(player)].name;
  if (refused.taken_by >= 0) {
    return name + ": " + scene.players[static_cast<std::size_t>(refused.taken_by)].name +
           " sits in " + seat.name;
  }
  char text[80];
  std::snprintf(text, sizeof text, " is %.1f m away, its reach is %.1f m",
                static_cast<double>(refused.away), static_cast<double>(seat.reach));
  return name + ": no seat within reach; " + seat.name + text;
}

/// True if one of the player's pressed buttons also does something without a seat.
bool DoesMore(const Scene& scene, int player, int pressed) {
  const std::vector<Action>& actions = scene.players[static_cast<std::size_t>(player)].actions;
  const auto acts = [pressed](const Action& a) { return ((pressed >> a.button) & 1) != 0; };
  const auto pushes = [&](const Thrust& thrust) {
    return thrust.player == player && thrust.button >= 0 && ((pressed >> thrust.button) & 1) != 0;
  };
  return std::any_of(actions.begin(), actions.end(), acts) ||
         std::any_of(scene.thrusts.begin(), scene.thrusts.end(), pushes);
}

}  // namespace

void Server::RunSeats(std::int64_t now_us) {
  const World& world = replica_.world();
  if (world.scene().seats.empty()) return;
  std::set<int> taken;  // the first in the order of players gets it
  for (int p = 0; p < static_cast<int>(scene_.players.size()); ++p) {
    const int pressed = replica_.TakePressed(p);
    if (pressed != 0 && Doubted(p)) continue;  // what is on probation enters nothing
    const std::vector<Edit> edits = SeatEdits(world, p, pressed, &taken);
    for (const Edit& edit : edits) edits_->Add(edit);
    if (pressed != 0 && edits.empty()) RefuseSeat(now_us, p, pressed, taken);
  }
  FreeSeats(now_us);
  int heard = replica_.revision();
  if (!config_.sync.policy->AppliesFoundEdits()) {  // else all peers act at the same tick
    // Waits for joining clients, too.
    sessions_.ForEachSentRoom([&](const Session& s) { heard = std::min(heard, s.revision); });
  }
  for (const Edit& edit : seat_bonds_.Next(world, heard)) edits_->Add(edit);
}

/// Tells the room, its scripts and the player.
void Server::RefuseSeat(std::int64_t now_us, int player, int pressed, const std::set<int>& taken) {
  const Scene& scene = replica_.world().scene();
  const SeatRefusal refused = RefusedSeat(replica_.world(), player, pressed, taken);
  if (refused.seat < 0 || DoesMore(scene, player, pressed)) return;
  std::int64_t& told_us = seat_told_us_[player];
  if (told_us != 0 && now_us - told_us < kRefuseAgainUs) return;
  told_us = now_us;
  Event told = MakeEvent(EventKind::kSeatRefused, Describe(scene, player, refused), player);
  told.index = refused.seat;
  const Event event = chronicle_->Say(now_us, told);
  if (rules_ != nullptr) {
    rules_->OnSeat(player, refused.seat,
                   refused.taken_by >= 0 ? SeatNews::kTaken : SeatNews::kTooFar);
  }
  Session* session = sessions_.Find(sessions_.PeerOfPlayer()[static_cast<std::size_t>(player)]);
  if (session != nullptr) sessions_.SendTo(*session, Encode(event));
}

/// Frees the seats of players who will not come back: their places have ended.
void Server::FreeSeats(std::int64_t now_us) {
  if (config_.sync.policy->IsOracle()) return;  // its players need no clients
  const std::vector<Seat>& seats = replica_.world().scene().seats;
  for (std::size_t s = 0; s < seats.size(); ++s) {
    const int index = static_cast<int>(s), player = seats[s].player;
    if (player < 0 || sessions_.IsReserved(now_us, player)) {
      seats_freed_.erase(index);
    } else if (seats_freed_.insert(index).second) {
      for (const Edit& edit : LeaveSeat(replica_.world(), index)) edits_->Add(edit);
    }
  }
}

}  // namespace seam
