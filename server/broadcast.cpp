#include "server/broadcast.h"

#include <utility>

#include "common/sync/lease.h"

namespace seam {
namespace {

/// A message is taken for lost when it is not acknowledged after so long, us: as reliable ones are,
/// and a little more, since who has nothing to say acknowledges late.
std::int64_t LateUs(std::int64_t rtt_us) {
  constexpr std::int64_t kUnknownUs = 250000, kMoreUs = 50000;
  return (rtt_us < 0 ? kUnknownUs : rtt_us + rtt_us / 4) + kMoreUs;
}

}  // namespace

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
  const bool for_silent = from_peer == 0 && states.peer != 0;
  const double repeat_s = for_silent ? kNewsRepeatSilent : kNewsRepeat;
  const std::vector<News>& news = newest_.Take(states, repeat_s);
  entries_.clear();
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(states.id[i]);
    if (body < 0) continue;  // it has left meanwhile
    entries_.push_back({states.id[i], replica_.world().mechanism(body), news[i]});
  }
  sessions_.ForEachReady(from_peer, [&](Session& session) {
    FindDue(session.peer);
    if (due_.size() == states.id.size() && session.outbox.empty() &&
        session.outbox.Affords(now_us, due_.size())) {
      session.packer.Add(states);
      return;
    }
    for (const auto& [id, urgency] : due_) session.outbox.Add(now_us, id, urgency);
  });
}

void Broadcast::Send(std::int64_t now_us, Session& session, std::vector<Grants> messages) {
  for (Grants& grants : messages) {
    grants.utime = now_us;
    sessions_.SendTo(session, Encode(grants));
  }
}

void Broadcast::Tell(const std::vector<Grants>& changes) {
  if (changes.empty()) return;
  for (const Grants& grants : changes) publisher_.Publish(grants);
  grant_news_.Take(changes);
  if (Plain() || interest_.small()) {
    for (const Grants& grants : changes) sessions_.SendToAll(Encode(grants));
    return;
  }
  const std::int64_t now_us = changes.back().utime;
  sessions_.ForEachTold(
      [&](Session& session) { Send(now_us, session, grant_news_.For(session.peer)); });
}

void Broadcast::TellOwed(std::int64_t now_us) {
  const std::int64_t every = GrantNews::kOwedS * config_.tick_hz;
  sessions_.ForEachTold([&](Session& session) {
    // Not all in the same tick.
    if ((replica_.tick() + 7 * session.peer) % every != 0) return;
    Send(now_us, session, grant_news_.Owed(session.peer, GrantNews::Which::kAll));
  });
}

/// Who is only shown a body hears of it when it is not as it would be guessed from what was told
/// last: if that was lost, the guess is another one, and in the end stands still.
void Broadcast::TellLostAgain(std::int64_t now_us, Session& session) {
  // Who says nothing acknowledges nothing either.
  if (now_us - session.link.last_receive_us() > kSilentUs) return;
  const auto shown = [&](std::int32_t id) {
    const int body = newest_.has(id) ? replica_.world().BodyOfId(id) : -1;
    return body >= 0 && !Simulates(session.peer, replica_.world().mechanism(body));
  };
  const std::int64_t late_us = LateUs(session.link.rtt_us());
  for (const std::int32_t id : session.packer.TakeLost(now_us, late_us, shown)) {
    session.outbox.Add(now_us, id, Urgency::kNear);
  }
}

void Broadcast::SendWaiting(std::int64_t now_us, bool stepped) {
  sessions_.ForEachReady(0, [&](Session& session) {
    if (stepped) TellLostAgain(now_us, session);
    const bool now = stepped || session.outbox.pressing() || !session.packer.empty();
    if (now && !session.outbox.empty()) {
      for (const States& s : session.outbox.Compose(now_us, newest_)) session.packer.Add(s);
    }
    for (const StatesPacker::Message& message : session.packer.Take(now_us)) {
      const Bytes bytes = Encode(message.packed);
      session.outbox.NoteCost(bytes.size(), message.bodies);
      session.link.SendUnreliable(bytes, kListedSlot, message.number);
    }
  });
}

void Broadcast::LookAround(std::int64_t now_us) {
  const bool anew = std::exchange(stale_, false);
  if (Plain()) return;
  std::vector<Interest::Receiver> receivers;
  sessions_.ForEachReady(0, [&](const Session& session) {
    receivers.push_back({session.peer, session.player});
  });
  const Composition& made = replica_.world().composition();
  std::vector<int> near;  // of one receiver: they come one after the other
  const std::vector<Interest::Risen> all = interest_.Look(receivers);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Interest::Risen& risen = all[i];
    Session* session = sessions_.Find(risen.peer);
    near.push_back(risen.mechanism);
    if (i + 1 == all.size() || all[i + 1].peer != risen.peer) {
      Send(now_us, *session, grant_news_.Owed(risen.peer, near));
      near.clear();
    }
    for (const int assembly :
         made.mechanisms[static_cast<std::size_t>(risen.mechanism)].assemblies) {
      const PartId id = made.assemblies[static_cast<std::size_t>(assembly)].id;
      if (newest_.has(id)) session->outbox.Add(now_us, id, Urgency::kNear);
    }
  }
  if (!anew) return;
  // Edits have made others of them: what came near is not known, and what was merged is urgent.
  sessions_.ForEachTold([&](Session& session) {
    Send(now_us, session, grant_news_.Owed(session.peer, GrantNews::Which::kNear));
  });
}

void Broadcast::Remap(const BodyRemap& change) {
  newest_.Remap(change.bodies);
  interest_.Remap();
  grant_news_.Remap(change.mechanisms);
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
