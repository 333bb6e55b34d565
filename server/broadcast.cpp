#include "server/broadcast.h"

namespace seam {
namespace {

/// Remote mechanisms are relayed every so many sends.
constexpr std::int64_t kFarEvery = 3;

}  // namespace

void Broadcast::Relay(const States& states, int from_peer) {
  const Bytes bytes = Encode(states);
  const bool everyone =
      config_.mode != Mode::kBuffer || (states.tick / config_.send_every()) % kFarEvery == 0;
  sessions_.ForEachReady(from_peer, [&](Session& session) {
    bool needed = everyone;
    for (std::size_t i = 0; i < states.id.size() && !needed; ++i) {
      const int body = replica_.world().BodyOfId(states.id[i]);
      needed = body >= 0 && authority_.Follows(session.peer, body);  // else it has left meanwhile
    }
    if (needed) session.link.SendUnreliable(bytes);
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
