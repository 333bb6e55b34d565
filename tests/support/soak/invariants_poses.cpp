/// Invariants of rest and of poses.

#include <algorithm>

#include "common/sync/rest/rest_islands.h"
#include "tests/support/replica_test_access.h"
#include "tests/support/soak/invariants.h"
#include "tests/support/soak/server_test_access.h"

namespace seam {
namespace {

/// Time until a lost announcement of rest is known again: RestBlocks finds that out within three
/// seconds, plus the time in which each block has its turn twice.
constexpr std::int64_t kRestKnownUs = 7000000, kRestBlockUs = 200000;
/// A body must be bit for bit the same once its holder has not moved it for so long, us, except
/// where something moves it here: there it must not come to rest differently, us.
constexpr std::int64_t kStillUs = 10000000, kStillElsewhereUs = 3000000;
/// A copy is no farther off than this, m, for longer than this, us.
constexpr double kFar = 10;
constexpr std::int64_t kFarUs = 5000000;

bool SameBits(const BodyState& a, const BodyState& b) {
  return a.position == b.position && a.angle == b.angle;
}

std::string Text(const RestRecord& record) {
  if (!record.committed) return "free";
  return "rests since tick " + std::to_string(record.tick) + " in epoch " +
         std::to_string(record.epoch);
}

}  // namespace

void Invariants::LookAtRest() {
  const Replica& server = *peers_[0].replica;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    Peer& peer = peers_[p];
    if (peer.replica == nullptr || peer.replica->revision() != server.revision()) continue;
    std::map<PartId, std::int64_t> other_us;
    for (int body = 0; body < server.world().body_count(); ++body) {
      const RestRecord& ours = server.rest().record(body);
      const RestRecord& theirs = peer.replica->rest().record(body);
      const World& world = peer.replica->world();
      const PartId id = world.id(body);
      const std::string who =
          "body " + std::to_string(id) + " at peer " + std::to_string(peer.self);
      // A state of its motion that has just arrived is about to end its rest.
      const bool lies = !world.awake(body) && world.Read(body).velocity.norm() == 0;
      if (peer.replica->rest().Holds(body) && lies) {
        ++reached_rest_;
        if (!SameBits(world.Read(body), theirs.pose)) Say("what rests lies where it rests", who);
      }
      const bool same_word = ours.committed && theirs.committed && ours.epoch == theirs.epoch &&
                             ours.tick == theirs.tick;
      const bool equal = ours.committed && theirs.committed && ours.epoch == theirs.epoch &&
                         SameBits(ours.pose, theirs.pose);
      if (same_word && !equal) Say("rest is the same everywhere", who);
      if (equal || !ours.committed || !Well(p, kToldUs)) continue;
      const auto since = peer.rest_other_us.find(id);
      other_us[id] = since == peer.rest_other_us.end() ? cluster_.now_us() : since->second;
      const int blocks = RestBlock::Of(server.world().body_count(), 0).blocks;
      if (cluster_.now_us() - other_us[id] <= kRestKnownUs + blocks * kRestBlockUs) continue;
      Say("rest is known everywhere", who + ": " + Text(theirs) + "; at the server: " + Text(ours));
    }
    peer.rest_other_us = std::move(other_us);
  }
}

/// The holder, if it knows so; nullptr: nobody just now, or a faulty one.
const Replica* Invariants::HolderOf(PartId body) const {
  const Replica& server = *peers_[0].replica;
  const World& world = server.world();
  const int holder = server.authority().at(world.mechanism(world.BodyOfId(body))).authority;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const Peer& peer = peers_[p];
    if (peer.replica == nullptr || peer.self != holder || !Well(p, kToldUs)) continue;
    if (peer.replica->revision() != server.revision()) continue;
    const int m = peer.replica->world().mechanism(peer.replica->world().BodyOfId(body));
    return peer.replica->authority().at(m).authority == holder ? peer.replica : nullptr;
  }
  return nullptr;
}

/// Records bodies that have not moved by a bit at their holder, and since when.
void Invariants::NoteStill() {
  const World& world = peers_[0].replica->world();
  std::map<PartId, Still> still;
  for (int body = 0; body < world.body_count(); ++body) {
    const PartId id = world.id(body);
    const Replica* const holder = HolderOf(id);
    if (holder == nullptr) continue;
    const BodyState truth = holder->world().Read(body);
    const auto was = still_.find(id);
    const bool same = was != still_.end() && SameBits(was->second.pose, truth);
    still[id] = {truth, same ? was->second.since_us : cluster_.now_us()};
  }
  still_ = std::move(still);
}

bool Invariants::Lies(PartId body) const {
  const auto still = still_.find(body);
  return still != still_.end() && cluster_.now_us() - still->second.since_us >= kStillUs;
}

/// True if all bodies of its mechanism or in contact with it at its holder are at rest: a car on
/// its back with turning wheels never sleeps, and its states keep the wire's rounding for ever.
bool Invariants::IslandLies(const Replica& holder, int body) const {
  for (const std::vector<int>& island : FindPresentIslands(holder.world())) {
    if (!std::binary_search(island.begin(), island.end(), body)) continue;
    return std::all_of(island.begin(), island.end(),
                       [&](int other) { return Lies(holder.world().id(other)); });
  }
  return true;  // what is absent there touches nothing
}

/// A peer has the holder's moving bodies roughly, and those at rest for long exactly.
void Invariants::LookAtPoses() {
  const Replica& server = *peers_[0].replica;
  const std::int64_t now_us = cluster_.now_us();
  const bool sleeps = server.world().scene().solver.sleep;
  std::vector<std::map<PartId, std::int64_t>> far_us(peers_.size());
  std::vector<std::map<PartId, Still>> elsewhere(peers_.size());
  NoteStill();
  for (int body = 0; body < server.world().body_count(); ++body) {
    const PartId id = server.world().id(body);
    const Replica* const holder = HolderOf(id);
    if (holder == nullptr) continue;
    const BodyState truth = holder->world().Read(body);
    const bool lies = sleeps && Lies(id);
    for (std::size_t p = 0; p < peers_.size(); ++p) {
      const Peer& peer = peers_[p];
      if (peer.replica == nullptr || !Well(p, kBackUs)) continue;
      if (peer.replica->revision() != server.revision()) continue;
      const BodyState there = peer.replica->world().Read(body);
      const double off = double{(there.position - truth.position).norm()};
      const auto who = [&, self = peer.self, holder = holder] {
        return "body " + std::to_string(id) + " at peer " + std::to_string(self) + " is " +
               std::to_string(off) + " m from where its holder has it (" +
               Text(peer.replica->rest().record(body)) + "; at its holder " +
               Text(holder->rest().record(body)) + ")";
      };
      // A peer hears of distant bodies now and then.
      const int m = server.world().mechanism(body);
      const bool nothing = p > 0 && ServerTestAccess::RelevanceOf(cluster_.server(), peer.self,
                                                                  m) == Relevance::kNone;
      if (lies && !nothing && !SameBits(there, truth) && IslandLies(*holder, body)) {
        const auto seen = peer.still_elsewhere.find(id);
        const bool stays = seen != peer.still_elsewhere.end() && SameBits(seen->second.pose, there);
        elsewhere[p][id] = {there, stays ? seen->second.since_us : now_us};
        if (now_us - elsewhere[p][id].since_us > kStillElsewhereUs) {
          Say("what lies still lies so everywhere", who());
        }
      }
      if (off <= kFar || strict_ || nothing) continue;
      if (ReplicaTestAccess::OutOfSight(*peer.replica, body, truth.position)) continue;
      const auto since = peer.far_us.find(id);
      far_us[p][id] = since == peer.far_us.end() ? now_us : since->second;
      if (now_us - far_us[p][id] > kFarUs) Say("bodies are where they are", who());
    }
  }
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    peers_[p].far_us = std::move(far_us[p]);
    peers_[p].still_elsewhere = std::move(elsewhere[p]);
  }
}

}  // namespace seam
