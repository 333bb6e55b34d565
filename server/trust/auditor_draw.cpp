/// Auditor: draws the clients that it follows.

#include <algorithm>
#include <tuple>

#include "common/sync/peer_set.h"
#include "server/trust/auditor.h"

namespace seam {
namespace {

/// Time between two draws, s: two or three comparisons.
constexpr double kDrawS = 0.5;
/// A client with this share of a lie is drawn again.
constexpr double kMayLie = 0.2;
/// Bodies of clients that take turns which are followed at a time: at least, and one for so many
/// clients. More find lies of many clients sooner and cost more; with fewer, cars that collide are
/// seldom compared, since all that they met must be followed too.
constexpr std::int64_t kTurnBodiesLeast = 24, kClientsForBody = 3;

}  // namespace

/// What is asleep and was not told of lately costs nothing.
bool Auditor::Moves(int mechanism) const {
  const std::int64_t followed = replica_.tick() - Seconds(kBehindS);
  return !Asleep(mechanism) || tracks_[mechanism].told.newest() > followed;
}

/// Clients in random order, each with what it drives first, as long as there is room. A client that
/// may lie, and a character, whose step is lost by a pause, are followed all the time; the rest
/// take turns.
void Auditor::Draw() {
  const AuthorityTable& table = replica_.authority();
  const Drivers& drivers = replica_.drivers();
  const auto players = static_cast<int>(noted_.size());
  std::vector<char> driven(static_cast<std::size_t>(table.count()), 0);
  driven_by_others_.assign(driven.size(), 0);
  for (int p = 0; p < players; ++p) {
    for (const int m : drivers.MovedBy(p)) {
      const auto own = static_cast<std::size_t>(m);
      if (tracks_[m].player >= 0 && tracks_[m].player != p) driven_by_others_[own] = 1;
      driven[own] = 1;
    }
  }
  // The order of the clients: those that may lie, then those not followed for the longest time.
  struct Candidate {
    double order = 0;
    int peer = -1;
    bool rides = false;
    int mechanism = -1;
  };
  std::vector<double> order(static_cast<std::size_t>(kPeersMax), 0);
  for (std::size_t peer = 0; peer < order.size(); ++peer) {
    order[peer] = static_cast<double>(followed_[peer]) + random_.Uniform(0, Seconds(kDrawS));
  }
  std::vector<Candidate> all;
  PeerSet holders;
  watched_.clear();
  for (int m = 0; m < table.count(); ++m) {
    const int peer = table.at(m).authority;
    if (peer <= 0) continue;
    holders.Add(peer);
    if (Moves(m)) watched_.push_back(m);
    all.push_back({0, peer, driven[static_cast<std::size_t>(m)] == 0, m});
    const bool may_lie = Moves(m) && tracks_[m].peer == peer && tracks_[m].gain.share() > kMayLie;
    if (may_lie) order[static_cast<std::size_t>(peer)] = -1;
  }
  for (Candidate& c : all) c.order = order[static_cast<std::size_t>(c.peer)];
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.order, a.peer, a.rides, a.mechanism) <
           std::tie(b.order, b.peer, b.rides, b.mechanism);
  });
  const Solver& solver = replica_.world().scene().solver;
  const std::int64_t most = kStepsPerS / (solver.tick_hz * solver.substeps);
  const std::int64_t by_turns =
      std::max(kTurnBodiesLeast, std::int64_t{holders.size()} / kClientsForBody);
  std::int64_t bodies = 0, of_turns = 0;
  std::vector<char> in(driven.size(), 0);
  players_.clear();
  for (const Candidate& c : all) {
    const auto size = static_cast<std::int64_t>(size_[static_cast<std::size_t>(c.mechanism)]);
    const std::int64_t more = Moves(c.mechanism) ? size : 0;
    const bool turn = c.order >= 0 && !Walks(c.mechanism);
    if (bodies + more > most || (turn && of_turns > 0 && of_turns + more > by_turns)) continue;
    bodies += more;
    if (turn) of_turns += more;
    in[static_cast<std::size_t>(c.mechanism)] = 1;
    if (more > 0) followed_[static_cast<std::size_t>(c.peer)] = replica_.tick();
  }
  for (int m = 0; m < table.count(); ++m) {
    tracks_[m].drawn = in[static_cast<std::size_t>(m)] != 0;
    if (!tracks_[m].drawn) {
      Leave(m);
      LoseStep(m);
    } else if (!tracks_[m].told.empty()) {
      Activate(m);
    }
  }
  for (int p = 0; p < players; ++p) {
    const std::vector<int>& moved = drivers.MechanismsOf(p);
    const bool any = std::any_of(moved.begin(), moved.end(),
                                 [&](int m) { return in[static_cast<std::size_t>(m)] != 0; });
    if (any || drivers.MovesBelt(p)) players_.push_back(p);
  }
  draw_at_ = replica_.tick() + Seconds(kDrawS);
}

}  // namespace seam
