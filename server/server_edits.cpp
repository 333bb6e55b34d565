/// Server, topology: peers propose, the server orders, everyone applies in that order. Two
/// mechanisms that are to become one first come into one hand, so that there are never two
/// authorities over what they become.

#include <algorithm>
#include <cmath>

#include "common/codec/codec.h"
#include "common/physics/part_places.h"
#include "common/sync/edit_order.h"
#include "server/authority/proposal.h"
#include "server/server.h"

namespace seam {
namespace {

/// A proposal that cannot be ordered yet (its parts are changing commands) is forgotten after this,
/// s.
constexpr double kPatience = 3;
/// Proposals that may wait; a hostile peer could send many.
constexpr std::size_t kPendingMax = 1024;
/// Edits in the life of a room: who joins late gets them all.
constexpr std::size_t kEditsMax = 8192;

}  // namespace

void Server::Order(const Edit& edit) {
  if (pending_.size() < kPendingMax) pending_.push_back({edit, 0, replica_.tick()});
}

void Server::OnProposal(Session& session, const EditOrder& order) {
  if (session.stage != SessionStage::kReady || order.number != -1) {
    ++stats_.dropped_right;
    return;
  }
  const Edit edit = ToEdit(order);
  const Topology& topology = replica_.world().topology();
  if (!topology.Complaint(edit).empty()) {
    ++stats_.dropped_stale;  // somebody else's came first
    return;
  }
  const std::vector<PartId> parts = topology.PartsOf(edit);
  const bool right = !parts.empty() && MayPropose(topology, edit) &&
                     std::any_of(parts.begin(), parts.end(), [&](PartId part) {
                       const int m = MechanismOf(replica_.world(), part);
                       return m >= 0 && authority_.Has(session.peer, m);
                     });
  if (!right) {
    ++stats_.dropped_right;
    return;
  }
  if (!PlausibleProposal(replica_.world(), edit)) {
    ++stats_.dropped_implausible;
    return;
  }
  if (pending_.size() < kPendingMax) pending_.push_back({edit, session.peer, replica_.tick()});
}

std::vector<int> Server::MechanismsOf(const Edit& edit) const {
  std::vector<int> mechanisms;
  for (const PartId part : replica_.world().topology().PartsOf(edit)) {
    const int m = MechanismOf(replica_.world(), part);
    if (m >= 0) mechanisms.push_back(m);
  }
  return mechanisms;
}

void Server::OrderPending(std::int64_t now_us) {
  const Topology& topology = replica_.world().topology();
  const auto patience = static_cast<std::int64_t>(kPatience * config_.sync.tick_hz);
  std::vector<Pending> waiting;
  std::vector<EditOrder> ordered;
  std::vector<PartId> taken;  // parts that an edit of this batch is about
  for (Pending& pending : pending_) {
    if (!topology.Complaint(pending.edit).empty()) {
      if (pending.peer > 0) ++stats_.dropped_stale;
      continue;
    }
    const std::vector<PartId> parts = topology.PartsOf(pending.edit);
    const bool again = std::any_of(parts.begin(), parts.end(), [&](PartId part) {
      return std::find(taken.begin(), taken.end(), part) != taken.end();
    });
    const bool bond = pending.edit.kind == EditKind::kBond;
    if ((bond && again) || !authority_.InOneHand(MechanismsOf(pending.edit))) {
      if (replica_.tick() - pending.since < patience) waiting.push_back(pending);
      continue;
    }
    const bool found = pending.edit.cause == EditCause::kPhysics;
    if (found && !PlausibleProposal(replica_.world(), pending.edit)) continue;  // it has moved on
    if (edits_.size() == kEditsMax) {
      if (!full_) Say(now_us, "no more edits: the room has had " + std::to_string(kEditsMax));
      full_ = true;
      continue;
    }
    taken.insert(taken.end(), parts.begin(), parts.end());
    EditOrder order = ToOrder(pending.edit);
    order.utime = now_us;
    order.tick = replica_.tick();
    order.number = static_cast<std::int32_t>(edits_.size());
    edits_.push_back(order);
    ordered.push_back(order);
  }
  pending_ = std::move(waiting);
  if (ordered.empty()) return;
  for (const EditOrder& order : ordered) {
    publisher_.Publish(order);
    SendToAll(Encode(order));
    replica_.Queue(order);
  }
  while (replica_.has_queued()) FollowTopology(replica_.ApplyNextEdit());
}

void Server::FollowTopology(const std::optional<BodyRemap>& change) {
  hash_after_[replica_.revision()] = replica_.world().composition().hash;
  if (!change) return;
  std::vector<LastAccepted> accepted;
  for (const BodyOrigin& origin : change->bodies) {
    accepted.push_back(origin.same ? accepted_[static_cast<std::size_t>(origin.body)]
                                   : LastAccepted{});
  }
  accepted_ = accepted;
  authority_.Remap(change->mechanisms);
}

void Server::CheckComposition(std::int64_t now_us, Session& session, const Ping& ping) {
  if (session.stage != SessionStage::kReady || ping.revision < 0) return;
  const auto known = hash_after_.find(ping.revision);
  const bool never = ping.revision > static_cast<std::int32_t>(edits_.size());
  const bool other =
      known != hash_after_.end() && known->second != static_cast<std::uint64_t>(ping.composition);
  if (!never && !other) return;
  // Once for each time it was repaired: what is under way must arrive first.
  if (now_us - session.repaired_us < kRepairAgainUs) return;
  session.repaired_us = now_us;
  Say(now_us, session.name + " (peer " + std::to_string(session.peer) +
                  ") has another composition after " + std::to_string(ping.revision) +
                  " edits: repaired");
  ++stats_.dropped_implausible;
  EditOrder anew;
  anew.utime = now_us;
  anew.tick = std::max<std::int64_t>(0, replica_.tick());
  session.link.SendReliable(Encode(anew));
  SendWorld(now_us, session);
}

void Server::SendWorld(std::int64_t now_us, Session& session) {
  for (const EditOrder& order : edits_) session.link.SendReliable(Encode(order));
  for (const Grants& g : authority_.Export(now_us)) {
    session.link.SendReliable(Encode(g));
  }
  if (!started()) return;
  for (States& states : replica_.Everything()) {
    states.utime = now_us;
    session.link.SendReliable(Encode(states));
  }
}

}  // namespace seam
