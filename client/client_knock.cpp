/// Client, knocking: a handshake with the room's standby beside the session, while our server is
/// silent. See docs/protocol.md, "Going on elsewhere".

#include <algorithm>

#include "client/client.h"

namespace seam {

void Client::OnRedirect(const Redirect& redirect) {
  Address at;
  if (moving_ || redirect.epoch != epoch_) {
    redirect_ = redirect;
  } else if (ReadAddress(redirect.address, &at)) {
    told_standby_ = at;
  }
}

void Client::KnockIfSilent(std::int64_t now_us) {
  const std::int64_t usual_us = std::max<std::int64_t>(0, clock_.rtt_p90_us());
  const bool silent = now_us - answered_us_ > kKnockAfterUs + usual_us && PongOverdue(now_us);
  const std::optional<Address>& standby = standby_ ? standby_ : told_standby_;
  const bool may = silent && standby && *standby != config_.server && key_of_ && epoch_ > 0;
  if (knocks_at_ && (!may || *knocks_at_ != *standby)) StopKnocking();
  if (!may) return;
  if (!knocks_at_) {
    knocks_at_ = standby;
    BeginJoin(now_us);
  }
  SendHelloOrJoin(now_us);
}

void Client::StopKnocking() {
  knocks_at_.reset();
  next_.reset();
  offers_.Clear();
}

}  // namespace seam
