#include "tests/support/soak/invariants.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/client_test_access.h"
#include "tests/support/replica_test_access.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace {

/// A hand-over is done, or its holder has to leave, within this long, us: kReleasePatienceUs and
/// kToldUs.
constexpr std::int64_t kHandedOverUs = 9000000;
/// A peer hears of bodies outside its interest area so much later, us.
constexpr std::int64_t kNothingUs = GrantAudience::kGrantPendingDistantS * std::int64_t{1000000};
/// Limits of pending edits, states and links: more would grow without end. A Link gives up at 4096.
constexpr std::size_t kLinkMax = 1500, kEditsMax = 300, kQueueMax = 600;
/// A body may be faster than the scene's limit for so many ticks on end: a correction of a rule
/// that does not know joints is over by then, an explosion is not.
constexpr int kFastTicksMax = 6;
/// Authority is looked at at every instant, rest and queues so many ticks apart.
constexpr std::int64_t kSeldomTicks = 15;

}  // namespace

Invariants::Invariants(Cluster& cluster, const FaultRunner& faults, bool strict)
    : cluster_(cluster), faults_(faults), strict_(strict) {
  peers_.resize(static_cast<std::size_t>(cluster.client_count()) + 1);
  played_us_.resize(static_cast<std::size_t>(cluster.client_count()));
  for (const Part& part : cluster.scene().parts) top_ = std::max(top_, part.position.y());
}

void Invariants::Say(const std::string& what, const std::string& detail) {
  Broken& broken = broken_[what];
  if (broken.times++ > 0) return;
  char at[32];
  std::snprintf(at, sizeof at, "at %.3f s: ",
                static_cast<double>(cluster_.server().tick()) / cluster_.scene().solver.tick_hz);
  broken.first = at + detail;
}

/// True if a client's machine and network have been without faults for `for_us`.
bool Invariants::Well(std::size_t peer, std::int64_t for_us) const {
  if (peer == 0) return true;
  const std::int64_t since_us = faults_.WellSince(static_cast<int>(peer) - 1);
  return since_us >= 0 && cluster_.now_us() - since_us >= for_us;
}

void Invariants::Look() {
  LookAtClients();
  if (!cluster_.server().started()) return;
  FindPeers();
  LookAtAuthority();
  LookAtCompositions();
  if (cluster_.server().tick() == looked_tick_) return;
  looked_tick_ = cluster_.server().tick();
  LookAtBodies();
  if (looked_tick_ % kSeldomTicks != 0) return;
  LookForStrays();
  LookAtRest();
  LookAtPoses();
  LookAtQueues();
}

void Invariants::LookAtClients() {
  for (int c = 0; c < cluster_.client_count(); ++c) {
    const Client* client = cluster_.client(c);
    if (client == nullptr && faults_.Stopped(c)) continue;
    const auto who = [&] { return "client " + std::to_string(c); };
    const bool in = client != nullptr && client->peer() >= 0;
    const bool plays = in && client->running();
    std::int64_t& played_us = played_us_[static_cast<std::size_t>(c)];
    if (plays) played_us = cluster_.now_us();
    const bool due = Well(static_cast<std::size_t>(c) + 1, kBackUs) &&
                     cluster_.server().started() && cluster_.now_us() - played_us >= kBackUs;
    if (due && !plays) Say("who is well plays", who() + (in ? " does not start" : " is not in"));
    if (client == nullptr) continue;
    if (!client->fatal().empty()) Say("nobody is turned away", who() + ": " + client->fatal());
    if (client->closed()) Say("nobody is turned away", who() + " was told that the room is closed");
  }
}

void Invariants::FindPeers() {
  peers_[0].replica = &cluster_.server().replica();
  for (int c = 0; c < cluster_.client_count(); ++c) {
    Peer& peer = peers_[static_cast<std::size_t>(c) + 1];
    const Client* client = cluster_.client(c);
    const bool runs = client != nullptr && client->running() && !faults_.Stopped(c);
    const Replica* const replica = runs ? client->replica() : nullptr;
    if (replica == peer.replica && replica != nullptr) continue;
    peer = Peer();
    peer.replica = replica;
    peer.self = runs ? client->peer() : -1;
  }
}

void Invariants::LookAtAuthority() {
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    Peer& peer = peers_[p];
    if (peer.replica == nullptr) continue;
    const AuthorityTable& table = peer.replica->authority();
    const auto count = static_cast<std::size_t>(table.count());
    const bool edited = peer.revision != peer.replica->revision();
    peer.revision = peer.replica->revision();
    if (edited) peer.records.assign(count, Record{});
    if (p == 0 && edited) named_revisions_.insert(peer.revision);
    compared_ += static_cast<long>(count);
    for (std::size_t m = 0; m < count; ++m) {
      const AuthorityRecord& now = table.at(static_cast<int>(m));
      Record& seen = peer.records[m];
      if (seen.epoch == now.epoch && seen.authority == now.authority) continue;
      seen = {table.id(static_cast<int>(m)), now.authority, now.epoch};
      NoteRecord(peer, p, seen);
    }
  }
}

/// A mechanism's record has changed at a peer.
void Invariants::NoteRecord(const Peer& peer, std::size_t p, const Record& record) {
  const std::pair<PartId, std::int32_t> key{record.id, record.epoch};
  const std::string what = "mechanism " + std::to_string(record.id) + " in epoch " +
                           std::to_string(record.epoch) + ": peer ";
  const auto differs = [&](Holders* holders, int holder) {
    const auto [it, fresh] = holders->emplace(key, holder);
    return !fresh && it->second != holder;
  };
  if (p == 0 && differs(&named_, record.authority)) {
    Say("an epoch has one authority", what + std::to_string(named_.at(key)) +
                                          " was named, now peer " +
                                          std::to_string(record.authority));
  }
  if (record.authority != peer.self) return;
  if (differs(&believed_, peer.self)) {
    Say("an epoch has one authority", what + std::to_string(believed_.at(key)) + " and peer " +
                                          std::to_string(peer.self) + " believed to have it");
  }
  const auto named = named_.find(key);
  // The server applies many edits in one go: records named between two of them are not seen.
  const bool unseen = named == named_.end() && named_revisions_.count(peer.revision) == 0;
  if (p > 0 && !unseen && (named == named_.end() || named->second != peer.self)) {
    Say("an epoch has one authority",
        what + std::to_string(peer.self) + " believes to have it and was not named");
  }
  for (const Peer& other : peers_) {
    if (&other == &peer || other.replica == nullptr) continue;
    if (other.replica->revision() != peer.revision) continue;
    const int m = other.replica->authority().IndexOf(record.id);
    if (m < 0 || other.replica->authority().at(m).authority != other.self) continue;
    Say("a mechanism has one authority at a time",
        what + std::to_string(peer.self) + ", while peer " + std::to_string(other.self) +
            " has it in epoch " + std::to_string(other.replica->authority().at(m).epoch));
  }
}

/// Compares all bodies, their assemblies and all joints: nothing is lost or doubled.
void Invariants::LookAtCompositions() {
  const Replica& server = *peers_[0].replica;
  for (std::size_t p = 1; p < peers_.size(); ++p) {
    Peer& peer = peers_[p];
    if (peer.replica == nullptr) continue;
    const bool behind = peer.replica->revision() != server.revision();
    if (!behind || peer.behind_us < 0 || !Well(p, kToldUs)) peer.behind_us = cluster_.now_us();
    const std::string who = "peer " + std::to_string(peer.self) + " after " +
                            std::to_string(peer.replica->revision()) + " of " +
                            std::to_string(server.revision()) + " edits";
    if (!behind && peer.replica->world().composition().hash != server.world().composition().hash) {
      Say("after the same edits all are made of the same", who);
    }
    if (cluster_.now_us() - peer.behind_us > kToldUs) Say("edits arrive", who);
  }
}

/// Finds peers that keep believing in another owner than the server's.
void Invariants::LookForStrays() {
  const Replica& server = *peers_[0].replica;
  for (std::size_t p = 1; p < peers_.size(); ++p) {
    Peer& peer = peers_[p];
    if (peer.replica == nullptr || !Well(p, kToldUs)) {
      peer.stray_us.clear();
      peer.stray_relevant_us.clear();
      continue;
    }
    if (peer.replica->revision() != server.revision()) continue;
    std::map<PartId, std::int64_t> stray_us, concern_us;
    for (int m = 0; m < server.authority().count(); ++m) {
      const AuthorityRecord& ours = server.authority().at(m);
      const AuthorityRecord& theirs = peer.replica->authority().at(m);
      if (ours.epoch == theirs.epoch && ours.authority == theirs.authority) continue;
      const PartId id = server.authority().id(m);
      const auto since = peer.stray_us.find(id);
      stray_us[id] = since == peer.stray_us.end() ? cluster_.now_us() : since->second;
      // The peer hears of a distant body when it becomes relevant, or much later.
      const bool nothing =
          ServerTestAccess::RelevanceOf(cluster_.server(), peer.self, m) == Relevance::kNone;
      const auto rose = peer.stray_relevant_us.find(id);
      concern_us[id] =
          nothing || rose == peer.stray_relevant_us.end() ? cluster_.now_us() : rose->second;
      if (cluster_.now_us() - concern_us[id] <= kHandedOverUs &&
          cluster_.now_us() - stray_us[id] <= kHandedOverUs + kNothingUs) {
        continue;
      }
      Say("grants arrive", "peer " + std::to_string(peer.self) + " believes that peer " +
                               std::to_string(theirs.authority) + " has mechanism " +
                               std::to_string(id) + " in epoch " + std::to_string(theirs.epoch) +
                               "; it is peer " + std::to_string(ours.authority) + " in epoch " +
                               std::to_string(ours.epoch));
    }
    peer.stray_us = std::move(stray_us);
    peer.stray_relevant_us = std::move(concern_us);
  }
}

void Invariants::LookAtBodies() {
  const double gravity = double{cluster_.scene().gravity.norm()};
  for (Peer& peer : peers_) {
    if (peer.replica == nullptr) continue;
    const World& world = peer.replica->world();
    for (int body = 0; body < world.body_count(); ++body) {
      const BodyState state = world.Read(body);
      const float speed = state.velocity.norm();
      ++compared_;
      const auto who = [&] {
        return "body " + std::to_string(world.id(body)) + " at peer " + std::to_string(peer.self);
      };
      const bool finite = state.position.allFinite() && state.velocity.allFinite() &&
                          std::isfinite(state.angle) && std::isfinite(state.spin);
      if (!finite) Say("all numbers are finite", who());
      // A body that falls out of the world gains its potential energy.
      const double fallen = std::max(0.0, double{top_} - double{state.position.y()});
      const double limit = double{cluster_.scene().speed_limit};
      const double by_falling = std::sqrt(2 * gravity * fallen);
      fastest_ = std::max(fastest_, speed);
      // A latecomer cannot receive its speed: States hold no more than the limit.
      const bool beyond_telling = by_falling > limit;
      if (double{speed} <= std::hypot(limit, by_falling) || beyond_telling || strict_) {
        if (!peer.fast_ticks.empty()) peer.fast_ticks.erase(world.id(body));
      } else if (++peer.fast_ticks[world.id(body)] > kFastTicksMax) {
        Say("nothing explodes", who() + ": " + std::to_string(speed) + " m/s");
      }
    }
  }
}

void Invariants::LookAtQueues() {
  const auto note = [&](const std::string& queue, std::size_t count, std::size_t most) {
    queues_[queue] = std::max(queues_[queue], count);
    if (count > most) Say("queues are bounded", queue + ": " + std::to_string(count));
  };
  note("server's links", ServerTestAccess::WaitingOfLinks(cluster_.server()), kLinkMax);
  note("server's edits", ServerTestAccess::WaitingEdits(cluster_.server()), kEditsMax);
  for (int c = 0; c < cluster_.client_count(); ++c) {
    const Client* client = cluster_.client(c);
    if (client != nullptr) note("client's link", ClientTestAccess::Waiting(*client), kLinkMax);
  }
  for (const Peer& peer : peers_) {
    if (peer.replica == nullptr) continue;
    for (const auto& [queue, count] : ReplicaTestAccess::Queues(*peer.replica)) {
      note(queue, count, kQueueMax);
    }
  }
}

}  // namespace seam
