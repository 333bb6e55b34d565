/// Server, received states: of moving bodies, at rest, and exact ones at a hand-over.

#include <algorithm>

#include "server/authority_source.h"
#include "server/server.h"

namespace seam {

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
  const States& kept = filter_.Keep(now_us, session.peer, states);
  if (kept.id.empty()) return;
  if (authority_.WatchesAgreement()) {
    replica_.EachDifference(
        kept, [this](int body, const BodyState& off) { authority_.NoteTold(body, off); });
  }
  stats_.counters.dropped_stale += replica_.Receive(kept).stale;
  if (rule_source_ != nullptr) rule_source_->NoteStates(kept);
  broadcast_.Relay(now_us, kept, session.peer);
  broadcast_.Publish(kept);
}

void Server::OnRest(std::int64_t now_us, Session& session, const Rest& rest) {
  if (session.stage != SessionStage::kReady) {
    ++stats_.counters.dropped_right;
    return;
  }
  const Rest kept = filter_.Keep(now_us, session.peer, rest);
  if (kept.id.empty()) return;
  replica_.Receive(kept);
  broadcast_.TellRest(kept, session.peer);
}

void Server::OnExactStates(std::int64_t now_us, const Session& session, const ExactStates& exact) {
  ExactStates kept = filter_.KeepExact(session.peer, exact);
  if (kept.id.empty()) return;
  kept.utime = now_us;
  const BodyState off = replica_.TakeOver(kept);
  const bool seen = off.position.norm() > AuthorityManager::kJump ||
                    off.velocity.norm() > AuthorityManager::kJumpVelocity;
  if (seen) ++stats_.jumps;
  for (const std::int32_t id : kept.id) {
    authority_.NoteCopyError(replica_.world().BodyOfId(id), off);
  }
  const Bytes bytes = Encode(kept);
  sessions_.ForEachReady(session.peer, [&](Session& other) {
    const bool awaits = std::any_of(kept.id.begin(), kept.id.end(), [&](std::int32_t id) {
      return authority_.Awaits(other.peer, replica_.world().BodyOfId(id));
    });
    if (awaits) sessions_.SendUrgentTo(other, bytes);
  });
}

}  // namespace seam
