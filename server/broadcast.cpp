#include "server/broadcast.h"

namespace seam {

bool Broadcast::Simulates(int peer, int mechanism) const {
  if (config_.mode == Mode::kOracle) return true;
  if (config_.mode == Mode::kCentral) return interest_.Of(peer, mechanism) == Concern::kClose;
  const AuthorityRecord& record = replica_.authority().at(mechanism);
  return record.authority == peer || record.secondaries.Has(peer);
}

void Broadcast::FindDue(int peer) {
  due_.clear();
  for (const Entry& entry : entries_) {
    const bool has = Simulates(peer, entry.mechanism);
    const Concern concern = has ? Concern::kClose : interest_.Of(peer, entry.mechanism);
    if (concern == Concern::kClose) {
      due_.emplace_back(entry.id, Urgency::kFollowed);
    } else if (concern == Concern::kNear && entry.news >= News::kNear) {
      due_.emplace_back(entry.id, Urgency::kNear);
    } else if (concern == Concern::kFar && entry.news == News::kAll) {
      due_.emplace_back(entry.id, Urgency::kFar);
    }
  }
}

void Broadcast::Relay(std::int64_t now_us, const States& states, int from_peer) {
  if (Plain()) {
    const Bytes whole = Encode(states);
    sessions_.ForEachReady(from_peer,
                           [&](Session& session) { session.link.SendUnreliable(whole); });
    return;
  }
  const std::vector<News>& news = newest_.Take(states);
  entries_.clear();
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(states.id[i]);
    if (body < 0) continue;  // it has left meanwhile
    entries_.push_back({states.id[i], replica_.world().mechanism(body), news[i]});
  }
  Bytes whole;  // encoded once somebody is due all of it
  sessions_.ForEachReady(from_peer, [&](Session& session) {
    FindDue(session.peer);
    if (due_.size() == states.id.size() && session.outbox.empty()) {
      if (whole.empty()) whole = Encode(states);
      if (session.outbox.Affords(now_us, whole.size())) {
        session.link.SendUnreliable(whole);
        return;
      }
    }
    for (const auto& [id, urgency] : due_) session.outbox.Add(now_us, id, urgency);
  });
}

void Broadcast::SendWaiting(std::int64_t now_us) {
  sessions_.ForEachReady(0, [&](Session& session) {
    if (session.outbox.empty()) return;
    for (States& states : session.outbox.Compose(now_us, newest_)) {
      states.utime = now_us;
      session.link.SendUnreliable(Encode(states));
    }
  });
}

void Broadcast::LookAround(std::int64_t now_us) {
  stale_ = false;
  if (Plain()) return;
  std::vector<Interest::Receiver> receivers;
  sessions_.ForEachReady(0, [&](const Session& session) {
    receivers.push_back({session.peer, session.player});
  });
  const Composition& made = replica_.world().composition();
  for (const Interest::Risen& risen : interest_.Look(receivers)) {
    Session* session = sessions_.Find(risen.peer);
    for (const int assembly :
         made.mechanisms[static_cast<std::size_t>(risen.mechanism)].assemblies) {
      const PartId id = made.assemblies[static_cast<std::size_t>(assembly)].id;
      if (newest_.has(id)) session->outbox.Add(now_us, id, Urgency::kNear);
    }
  }
}

void Broadcast::Remap(const std::vector<BodyOrigin>& bodies) {
  newest_.Remap(bodies);
  interest_.Remap();
  stale_ = true;
}

void Broadcast::Say(std::int64_t now_us, const std::string& text) {
  Event event;
  event.utime = now_us;
  event.tick = replica_.tick();
  event.text = text;
  Publish(event);
}

}  // namespace seam
