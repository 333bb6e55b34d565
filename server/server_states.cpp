/// Server, received states: of moving bodies, at rest, and exact ones at a hand-over.

#include <algorithm>
#include <map>
#include <vector>

#include "server/authority_source.h"
#include "server/server.h"
#include "server/trust/auditor.h"

namespace seam {
namespace {

/// Most messages that wait for the server's copies; a hostile peer must not fill the memory.
constexpr std::size_t kWaitingStatesMax = 1024;

}  // namespace

/// Unpacks states of a client that is not ready, too: it counts on those that have arrived.
void Server::OnPacked(std::int64_t now_us, Session& session, const PackedStates& packed) {
  const auto ids = static_cast<std::int32_t>(replica_.world().scene().parts.size());
  const std::vector<States>* const all = session.unpacker.Take(packed, ids);
  if (all == nullptr) {
    ++stats_.counters.dropped_malformed;
    session.link.SendUnreliable(Encode(StatesUnpacker::Refusal(packed)));
    return;
  }
  for (const States& states : *all) OnStates(now_us, session, states);
}

void Server::OnStates(std::int64_t now_us, Session& session, const States& states) {
  if (session.stage != SessionStage::kReady) {
    ++stats_.counters.dropped_right;
    return;
  }
  const auto waits = [&](const WaitingStates& other) { return other.peer == session.peer; };
  const bool behind = std::any_of(waiting_states_.begin(), waiting_states_.end(), waits);
  if (waiting_states_.size() < kWaitingStatesMax && (behind || filter_.Waits(states))) {
    waiting_states_.push_back({session.peer, replica_.tick(), states});
    return;
  }
  TakeStates(now_us, session, states);
}

void Server::TakeStates(std::int64_t now_us, Session& session, const States& states) {
  if (states.peer == session.peer) replica_.NoteDivergences(states);
  const States& kept = filter_.Keep(now_us, session.peer, states);
  FollowDoubts(now_us, session);
  if (kept.id.empty()) return;
  if (authority_.WatchesAgreement()) {
    replica_.EachDifference(
        kept, [this](int body, const BodyState& off) { authority_.NoteTold(body, off); });
  }
  stats_.counters.dropped_stale += replica_.Receive(kept).stale;
  if (rule_source_ != nullptr) rule_source_->NoteStates(kept);
  if (auditor_ != nullptr && session.player >= 0) auditor_->NoteTold(session.player, kept);
  broadcast_.Relay(now_us, kept, session.peer);
  broadcast_.Publish(kept);
}

void Server::OnDiffering(const Session& session, const Differing& differing) {
  std::vector<int> mechanisms;
  for (const std::int32_t id : differing.mechanism) {
    const int m = replica_.authority().IndexOf(id);
    const bool ready = session.stage == SessionStage::kReady;
    if (m >= 0 && ready && broadcast_.Simulates(session.peer, m)) {
      mechanisms.push_back(m);
    } else {
      ++(m < 0 ? stats_.counters.dropped_stale : stats_.counters.dropped_right);
    }
  }
  TellDiffering(session.peer, mechanisms);
}

void Server::TellDiffering(int peer, const std::vector<int>& mechanisms) {
  std::map<int, Differing> by_holder;
  for (const int m : mechanisms) {
    broadcast_.NoteDiffering(peer, m);
    if (!replica_.RefreshesOnly(m)) continue;
    const AuthorityTable& table = replica_.authority();
    Differing& told = by_holder[table.at(m).authority];
    if (told.mechanism.size() < kDifferingMax) told.mechanism.push_back(table.id(m));
  }
  for (const auto& [holder, told] : by_holder) {
    Session* const session = sessions_.Find(holder);
    if (session != nullptr) session->link.SendUnreliable(Encode(told));
  }
}

void Server::OnRest(std::int64_t now_us, Session& session, const Rest& rest) {
  if (session.stage != SessionStage::kReady) {
    ++stats_.counters.dropped_right;
    return;
  }
  const Rest kept = filter_.Keep(now_us, session.peer, rest);
  FollowDoubts(now_us, session);
  if (kept.id.empty()) return;
  replica_.Receive(kept);
  broadcast_.NoteAccepted(now_us, session.peer, session.player, kept);
  broadcast_.TellRest(kept, session.peer);
}

void Server::TellRest(std::int64_t now_us) {
  for (Rest& rest : replica_.rest().Take()) {
    rest.utime = now_us;
    broadcast_.TellRest(rest, 0);
  }
  const bool quiet = replica_.rest().all();
  sessions_.ForEachReady(
      0, [&](Session& session) { session.link.SetQuiet(quiet && session.rest_agrees); });
}

void Server::OnExactStates(std::int64_t now_us, Session& session, const ExactStates& exact) {
  ExactStates kept = filter_.KeepExact(session.peer, exact);
  FollowDoubts(now_us, session);
  if (kept.id.empty()) return;
  kept.utime = now_us;
  const BodyState off = replica_.TakeOver(kept);
  broadcast_.NoteAccepted(now_us, session.peer, session.player, kept);
  const bool seen = off.position.norm() > AuthorityManager::kJump ||
                    off.velocity.norm() > AuthorityManager::kJumpVelocity;
  if (seen) ++stats_.jumps;
  for (const std::int32_t id : kept.id) {
    authority_.NoteCopyError(replica_.world().BodyOfId(id), off);
  }
  const Bytes bytes = Encode(kept);
  PeerSet awaiting;
  for (const std::int32_t id : kept.id) {
    authority_.AddAwaiting(replica_.world().BodyOfId(id), &awaiting);
  }
  awaiting.Remove(session.peer);
  awaiting.Each([&](int peer) {
    Session* const other = sessions_.Find(peer);
    const bool ready = other != nullptr && other->stage == SessionStage::kReady;
    if (ready) sessions_.SendUrgentTo(*other, bytes);
  });
}

}  // namespace seam
