#include "server/broadcast.h"

#include <algorithm>
#include <utility>

#include "common/scene/mechanism_ids.h"
#include "common/sync/lease.h"
#include "server/interest/late.h"

namespace seam {

bool Broadcast::Simulates(int peer, int mechanism) const {
  if (simulators_ == Policy::Simulators::kEveryone) return true;
  if (simulators_ == Policy::Simulators::kNear) {
    return interest_.Of(peer, mechanism) == Relevance::kClose;
  }
  const AuthorityRecord& record = replica_.authority().at(mechanism);
  return record.authority == peer || record.secondaries.Has(peer);
}

void Broadcast::Send(std::int64_t now_us, Session& session, std::vector<Grants> messages) {
  for (Grants& grants : messages) {
    grants.utime = now_us;
    sessions_.SendUrgentTo(session, Encode(grants));
  }
}

void Broadcast::Tell(const std::vector<Grants>& changes) {
  if (changes.empty()) return;
  for (const Grants& grants : changes) publisher_.Publish(grants);
  grant_audience_.Take(changes);
  NoteFollowers(changes);
  if (Plain() || interest_.small()) {
    for (const Grants& grants : changes) sessions_.SendUrgentToAll(Encode(grants));
    return;
  }
  const std::int64_t now_us = changes.back().utime;
  PeerSet clients;
  sessions_.ForEachSentRoom([&](const Session& session) { clients.Add(session.peer); });
  grant_audience_.Sort(clients);
  sessions_.ForEachSentRoom(
      [&](Session& session) { Send(now_us, session, grant_audience_.For(session.peer)); });
  SendRestToFollowers(now_us, changes);
}

/// Sends pending rest commits to peers that begin to simulate a mechanism.
void Broadcast::SendRestToFollowers(std::int64_t now_us, const std::vector<Grants>& changes) {
  const AuthorityTable& table = replica_.authority();
  for (const Grants& grants : changes) {
    for (const std::int32_t id : grants.mechanism) {
      const int m = table.IndexOf(id);
      if (m < 0) continue;
      std::vector<int> peers = followers_[m];
      peers.push_back(table.at(m).authority);
      for (const int peer : peers) {
        Session* const session = sessions_.Find(peer);
        if (session != nullptr) SendPendingRest(now_us, *session, {m});
      }
    }
  }
}

/// Updates followers_ from the table: a message does not list all followers of a crowd.
void Broadcast::NoteFollowers(const std::vector<Grants>& changes) {
  const AuthorityTable& table = replica_.authority();
  for (const Grants& grants : changes) {
    for (const std::int32_t id : grants.mechanism) {
      const int m = table.IndexOf(id);
      if (m < 0) continue;
      followers_[m].clear();
      table.at(m).secondaries.Each([&](int peer) { followers_[m].push_back(peer); });
      NoteUnsettled(m);
    }
  }
}

void Broadcast::AddFollowers(const std::vector<int>& before, std::vector<int>* into) {
  into->insert(into->end(), before.begin(), before.end());
  std::sort(into->begin(), into->end());
  into->erase(std::unique(into->begin(), into->end()), into->end());
}

void Broadcast::FindFollowers() {
  PeerSet ready;
  sessions_.ForEachReady(0, [&ready](const Session& session) { ready.Add(session.peer); });
  const AuthorityTable& table = replica_.authority();
  for (int m = 0; m < table.count(); ++m) {
    std::vector<int>& followers = followers_[m];
    followers.clear();
    table.at(m).secondaries.Each([&](int peer) {
      if (ready.Has(peer)) followers.push_back(peer);
    });
  }
}

void Broadcast::NoteDiffering(int peer, int mechanism) {
  NoteUnsettled(mechanism);
  const World& world = replica_.world();
  const int body = world.BodyOfId(replica_.authority().id(mechanism));
  if (!config_.policy->SendsCompleteTicks()) return;
  if (body < 0 || world.activity(body) != Activity::kSimulated) return;  // we know no better
  if (peer > 0) return settled_worlds_.NoteDiffering(peer);
  EachSimulating(mechanism,
                 [this](const Session& each) { settled_worlds_.NoteDiffering(each.peer); });
}

void Broadcast::SendPendingGrants(std::int64_t now_us) {
  const std::int64_t every = GrantAudience::kGrantPendingS * config_.tick_hz;
  const std::int64_t every_nothing = GrantAudience::kGrantPendingDistantS * config_.tick_hz;
  sessions_.ForEachSentRoom([&](Session& session) {
    // Spread over ticks by peer.
    if ((replica_.tick() + 7 * session.peer) % every != 0) return;
    const bool all = (replica_.tick() + 7 * session.peer) % every_nothing == 0;
    const auto which = all ? GrantAudience::Which::kAll : GrantAudience::Which::kFar;
    Send(now_us, session, grant_audience_.Owed(session.peer, which));
  });
}

void Broadcast::AddNewest(std::int64_t now_us, Session& session, int mechanism, Urgency urgency) {
  EachIdOf(replica_.world().composition(), mechanism, [&](PartId id) {
    if (newest_.has(id)) session.send_queue.Add(now_us, id, urgency);
  });
}

/// Returns the peers that are sent rest commits of the mechanism at once: those to which it is in
/// interest, and those that simulate it.
PeerSet Broadcast::HearingRest(int mechanism) const {
  PeerSet hearing;
  for (const int peer : interest_.ReceiversFar(mechanism)) hearing.Add(peer);
  if (simulators_ == Policy::Simulators::kNear) return hearing;
  const AuthorityRecord& record = replica_.authority().at(mechanism);
  hearing.Add(record.authority);
  hearing.Add(record.secondaries);
  return hearing;
}

void Broadcast::TellRest(const Rest& rest, int from_peer) {
  const bool everyone = simulators_ == Policy::Simulators::kEveryone;
  if (Plain() || everyone || interest_.small() || interest_.unknown()) {
    sessions_.SendToAll(Encode(rest), from_peer);
    return;
  }
  PeerSet clients, all_ears;  // not ready yet, or not looked for
  sessions_.ForEachSentRoom([&](const Session& session) {
    if (session.peer == from_peer) return;
    clients.Add(session.peer);
    const bool looked_for = session.stage == SessionStage::kReady && interest_.Knows(session.peer);
    if (!looked_for) all_ears.Add(session.peer);
  });
  rest_audience_.Take(rest);
  rest_audience_.Sort(clients, [&](int mechanism) {
    PeerSet hearing = HearingRest(mechanism);
    hearing.Add(all_ears);
    return hearing;
  });
  sessions_.ForEachSentRoom([&](Session& session) {
    if (session.peer == from_peer) return;
    const Rest told = rest_audience_.For(session.peer);
    if (!told.id.empty()) sessions_.SendTo(session, Encode(told));
  });
}

void Broadcast::SendPendingRest(std::int64_t now_us, Session& session,
                                const std::vector<int>& mechanisms) {
  for (Rest& rest : rest_audience_.Owed(session.peer, mechanisms)) {
    rest.utime = now_us;
    sessions_.SendTo(session, Encode(rest));
  }
}

void Broadcast::RefreshDistant(std::int64_t now_us) {
  if (Plain() || interest_.small()) return;
  const int every = ticks_per_look();
  sessions_.ForEachReady(0, [&](Session& session) {
    // Spread over ticks by peer.
    if ((replica_.tick() + session.peer) % every == 0) RefreshDistant(now_us, session);
  });
}

void Broadcast::RefreshDistant(std::int64_t now_us, Session& session) {
  if (session.player < 0) return;
  constexpr int kEach = kDistantPerSecond / kInterestHz, kLookedAtMost = 16 * kEach;
  const Composition& made = replica_.world().composition();
  const int mechanisms = static_cast<int>(made.mechanisms.size());
  int& next = session.send_queue.nothing;
  int told = 0;
  std::vector<int> resting;
  // On a thin line grants wait for what was queued before them: poses at rest only fill gaps.
  const bool gap = now_us - session.link.SentUntilUs(now_us) <= 1000000 / kInterestHz;
  for (int i = 0; i < std::min(kLookedAtMost, mechanisms) && told < kEach; ++i) {
    if (next + 1 >= mechanisms) {
      if (now_us - session.send_queue.distant_round_us < kDistantEveryUs) break;
      session.send_queue.distant_round_us = now_us;
      next = -1;
    }
    ++next;
    const bool owed = gap && rest_audience_.IsPendingFor(session.peer, next);
    if (owed) resting.push_back(next);
    told += owed ? 1 : 0;
    if (interest_.Of(session.peer, next) != Relevance::kNone) continue;
    if (Simulates(session.peer, next)) continue;
    const bool moves = AnyIdOf(made, next, [&](PartId id) {
      return newest_.has(id) && (newest_.at(id).flags & kStateAsleep) == 0;
    });
    if (!moves) continue;
    AddNewest(now_us, session, next, Urgency::kFar);
    told += owed ? 0 : 1;
  }
  SendPendingRest(now_us, session, resting);
}

/// Queues again lost states of displayed bodies. A client that only displays a body gets no new
/// state while extrapolation of the last one is good; if that was lost, the client extrapolates an
/// older state, and finally stops.
void Broadcast::RequeueLost(std::int64_t now_us, Session& session) {
  // A silent client acknowledges nothing either.
  if (now_us - session.link.last_receive_us() > kSilentUs) return;
  const auto shown = [&](std::int32_t id) {
    const int body = newest_.has(id) ? replica_.world().BodyOfId(id) : -1;
    if (body < 0) return false;
    const int mechanism = replica_.world().mechanism(body);
    return !Predicts(session.peer, mechanism) &&
           interest_.Of(session.peer, mechanism) != Relevance::kNone;
  };
  const std::int64_t late_us = LateUs(session.link.rtt_us());
  for (const std::int32_t id : session.packer.TakeLost(now_us, late_us, shown)) {
    session.send_queue.Add(now_us, id, Urgency::kNear);
  }
}

void Broadcast::MarkForSending(const Session& session) {
  const auto p = static_cast<std::size_t>(session.peer);
  if (presses_.size() <= p) presses_.resize(p + 1, 0);
  if (std::exchange(presses_[p], 1) == 0) pressing_.push_back(session.peer);
}

/// Called with every datagram: between steps only sessions marked by MarkForSending are checked.
void Broadcast::SendWaiting(std::int64_t now_us, bool stepped) {
  const std::vector<int> pressing = std::exchange(pressing_, {});
  for (const int peer : pressing) presses_[static_cast<std::size_t>(peer)] = 0;
  if (stepped) {
    sessions_.ForEachReady(0, [&](Session& session) { SendWaitingTo(now_us, session, true); });
    return;
  }
  for (const int peer : pressing) {
    Session* const session = sessions_.Find(peer);
    const bool ready = session != nullptr && session->stage == SessionStage::kReady;
    if (ready) SendWaitingTo(now_us, *session, false);
  }
}

void Broadcast::SendWaitingTo(std::int64_t now_us, Session& session, bool stepped) {
  if (stepped) RequeueLost(now_us, session);
  const bool now = stepped || session.send_queue.pressing() || !session.packer.empty();
  if (now && !session.send_queue.empty()) {
    for (const SendQueue::Message& message : session.send_queue.Compose(now_us, newest_)) {
      session.packer.Add(message.header, message.begin, message.end);
    }
  }
  for (const StatesPacker::Message& message : session.packer.Take(now_us)) {
    const Bytes bytes = Encode(message.packed);
    session.send_queue.NoteCost(bytes.size(), message.bodies);
    session.link.SendUnreliable(bytes, {{kListedSlot, message.number}});
  }
  if (session.send_queue.pressing()) MarkForSending(session);  // beyond its budget
}

void Broadcast::LookAround(std::int64_t now_us) {
  const bool anew = stale();
  looked_at_ = replica_.table().renumbered();
  if (Plain()) return;
  if (std::exchange(peer_became_ready_, false) || anew) FindFollowers();
  std::vector<Interest::Receiver> receivers;
  sessions_.ForEachReady(0, [&](const Session& session) {
    receivers.push_back({session.peer, session.player});
  });
  std::vector<int> near;  // mechanisms of one receiver: receivers come one after the other
  const std::vector<Interest::Risen> all = interest_.Look(receivers);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Interest::Risen& risen = all[i];
    Session* session = sessions_.Find(risen.peer);
    near.push_back(risen.mechanism);
    if (i + 1 == all.size() || all[i + 1].peer != risen.peer) {
      Send(now_us, *session, grant_audience_.Owed(risen.peer, near));
      SendPendingRest(now_us, *session, near);
      near.clear();
    }
    AddNewest(now_us, *session, risen.mechanism, Urgency::kNear);
  }
  if (!anew) return;
  // After an edit the mechanisms that came near are not known, and merged ones are urgent.
  sessions_.ForEachSentRoom([&](Session& session) {
    Send(now_us, session, grant_audience_.Owed(session.peer, GrantAudience::Which::kNear));
  });
}

}  // namespace seam
