/// Broadcast, relay of states: finds the receivers of each entry of a message.

#include <algorithm>
#include <utility>

#include "common/physics/stage.h"
#include "common/sync/lease.h"
#include "server/broadcast.h"

namespace seam {

bool Broadcast::Predicts(int peer, int mechanism) const {
  if (!Simulates(peer, mechanism)) return false;
  if (simulators_ != Policy::Simulators::kNear) return true;
  const Session* const session = sessions_.Find(peer);
  if (session == nullptr || session->player < 0) return false;  // a spectator predicts nothing
  const std::vector<int>& own = replica_.drivers().MechanismsOf(session->player);
  return config_.policy->CopiesAgree() || std::binary_search(own.begin(), own.end(), mechanism);
}

std::optional<Urgency> Broadcast::DueTo(int peer, const Entry& entry) const {
  if (Predicts(peer, entry.mechanism)) {
    const bool due = entry.refresh || !replica_.CopiesAgree(entry.mechanism);
    if (entry.to_followers && due) return Urgency::kFollowed;
    return std::nullopt;
  }
  const Relevance relevance = interest_.Of(peer, entry.mechanism);
  if (relevance >= Relevance::kNear && entry.news >= News::kNear) return Urgency::kNear;
  if (relevance == Relevance::kFar && entry.news == News::kAll) return Urgency::kFar;
  return std::nullopt;
}

void Broadcast::AddDue(int peer, const Entry& entry, Urgency urgency) {
  const auto p = static_cast<std::size_t>(peer);
  if (due_.size() <= p) due_.resize(p + 1);
  if (due_[p].empty()) hearing_.push_back(peer);
  due_[p].emplace_back(entry.id, urgency);
}

/// Checks every entry for every peer: in a small room, or before the first Look.
void Broadcast::FindDueOfAny(int but_peer) {
  sessions_.ForEachReady(but_peer, [&](const Session& session) {
    for (const Entry& entry : entries_) {
      if (const auto urgency = DueTo(session.peer, entry)) AddDue(session.peer, entry, *urgency);
    }
  });
}

/// Most entries are due only to peers that simulate the body; no other peer is checked for them.
void Broadcast::FindDue(int but_peer) {
  for (const Entry& entry : entries_) {
    const AuthorityRecord& record = replica_.authority().at(entry.mechanism);
    const bool to_followers =
        entry.to_followers && (entry.refresh || !replica_.CopiesAgree(entry.mechanism));
    if (to_followers && record.authority != but_peer) {
      AddDue(record.authority, entry, Urgency::kFollowed);
    }
    for (const int peer : followers_[entry.mechanism]) {
      const bool follows = record.authority != peer && record.secondaries.Has(peer);
      if (to_followers && follows && peer != but_peer) {
        AddDue(peer, entry, Urgency::kFollowed);
      }
    }
    if (entry.news == News::kNobody) continue;
    const bool far = entry.news == News::kAll;
    const std::vector<int>& hearing =
        far ? interest_.ReceiversFar(entry.mechanism) : interest_.ReceiversNear(entry.mechanism);
    for (const int peer : hearing) {
      if (peer == but_peer || peer == record.authority || record.secondaries.Has(peer)) continue;
      const bool near = !far || interest_.Of(peer, entry.mechanism) >= Relevance::kNear;
      AddDue(peer, entry, near ? Urgency::kNear : Urgency::kFar);
    }
  }
}

/// Mode central: relevance alone decides which clients predict a mechanism.
void Broadcast::FindDueByRelevance(int but_peer) {
  for (const Entry& entry : entries_) {
    for (const int peer : interest_.ReceiversFar(entry.mechanism)) {
      if (peer == but_peer) continue;
      if (const auto urgency = DueTo(peer, entry)) AddDue(peer, entry, *urgency);
    }
  }
}

/// A follower of a silent holder's body knows as much of the body as the server: the last received
/// state, and the same inputs. A server that began to simulate the body only then knows less: not
/// the phase of a character's step, nor the load on a suspension or a contact. Its states count
/// once the driver's controls are released, which followers learn from the server alone.
bool Broadcast::SendsToFollowers(std::int64_t now_us, int holder, int body) {
  const World& world = replica_.world();
  const bool small = world.body_count() <= world.scene().server_follow && ShowsViews();
  const bool all_along = small || ProposesEdits(world.scene());
  if (all_along && replica_.SimulatedBefore(body)) return true;
  const Session* const session = sessions_.Find(holder);
  return session == nullptr || now_us - session->link.last_receive_us() > kDriverSilentUs;
}

void Broadcast::Relay(std::int64_t now_us, const States& states, int from_peer) {
  if (Plain()) {
    const Bytes whole = Encode(states);
    sessions_.ForEachReady(from_peer, [&](Session& session) {
      if (session.send_queue.Ready(now_us)) session.link.SendUnreliable(whole);
    });
    return;
  }
  const bool for_silent = from_peer == 0 && states.peer != 0;
  const double repeat_s = for_silent ? kStateRepeatSilentS : kStateRepeatS;
  const std::vector<NewestStates::Told>& told = newest_.Take(states, repeat_s);
  entries_.clear();
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = told[i].body;
    if (body < 0) continue;  // the body is gone
    const bool to_followers = !for_silent || SendsToFollowers(now_us, states.peer, body);
    const bool refresh = for_silent || told[i].refresh || Unsettled(told[i].mechanism);
    entries_.push_back({states.id[i], told[i].mechanism, told[i].news, to_followers, refresh});
  }
  hearing_.clear();
  if (interest_.small() || interest_.unknown()) {
    FindDueOfAny(from_peer);
  } else if (simulators_ == Policy::Simulators::kNear) {
    FindDueByRelevance(from_peer);
  } else {
    FindDue(from_peer);
  }
  for (const int peer : hearing_) {
    Due& due = due_[static_cast<std::size_t>(peer)];
    Session* const session = sessions_.Find(peer);
    if (session != nullptr && session->stage == SessionStage::kReady) {
      RelayDue(now_us, states, due, *session);
    }
    due.clear();
  }
}

void Broadcast::RelayDue(std::int64_t now_us, const States& states, const Due& due,
                         Session& session) {
  if (due.size() == states.id.size() && session.send_queue.empty() &&
      session.send_queue.Affords(now_us, due.size())) {
    session.packer.Add(states);
    session.send_queue.NoteFollowed(static_cast<std::size_t>(std::count_if(
        due.begin(), due.end(),
        [](const std::pair<PartId, Urgency>& one) { return one.second == Urgency::kFollowed; })));
    MarkForSending(session);
    return;
  }
  for (const auto& [id, urgency] : due) session.send_queue.Add(now_us, id, urgency);
  if (session.send_queue.pressing()) MarkForSending(session);
}

}  // namespace seam
