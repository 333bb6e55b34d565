#include "server/broadcast.h"

namespace seam {
namespace {

/// Some entries of a message, in their order.
States Some(const States& all, const std::vector<std::size_t>& entries) {
  States some = all;
  const auto take = [&](const auto& from, auto* to) {
    to->clear();
    for (const std::size_t i : entries) to->push_back(from[i]);
  };
  take(all.id, &some.id);
  take(all.epoch, &some.epoch);
  take(all.flags, &some.flags);
  take(all.x, &some.x);
  take(all.y, &some.y);
  take(all.angle, &some.angle);
  take(all.vx, &some.vx);
  take(all.vy, &some.vy);
  take(all.spin, &some.spin);
  return some;
}

}  // namespace

std::vector<std::size_t> Broadcast::Due(const States& states, Session* session) const {
  std::vector<std::size_t> due;
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const auto id = static_cast<std::size_t>(states.id[i]);
    const int body = replica_.world().BodyOfId(states.id[i]);
    if (body < 0) continue;  // it has left meanwhile
    if (session->told.size() <= id) session->told.resize(id + 1, -1);
    std::int64_t& told = session->told[id];
    int sends = 1;
    if (!authority_.Follows(session->peer, body)) {
      sends = authority_.IsFar(session->peer, body) ? kFarSends : kNearSends;
    }
    if (told >= 0 && states.tick < told + sends * config_.send_every() && sends > 1) continue;
    told = states.tick;
    due.push_back(i);
  }
  return due;
}

void Broadcast::Relay(const States& states, int from_peer) {
  const Bytes whole = Encode(states);
  sessions_.ForEachReady(from_peer, [&](Session& session) {
    if (config_.mode != Mode::kBuffer) return session.link.SendUnreliable(whole);
    const std::vector<std::size_t> due = Due(states, &session);
    if (due.empty()) return;
    const bool all = due.size() == states.id.size();
    session.link.SendUnreliable(all ? whole : Encode(Some(states, due)));
  });
}

void Broadcast::Say(std::int64_t now_us, const std::string& text) {
  Event event;
  event.utime = now_us;
  event.tick = replica_.tick();
  event.text = text;
  Publish(event);
}

}  // namespace seam
