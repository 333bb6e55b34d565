#include "server/relay/upstream_lines.h"

#include <utility>

#include "common/net/udp.h"

namespace seam {

std::string UpstreamLines::Next(const Client& client) {
  State now = State::kOutside;
  if (client.moving()) {
    now = State::kMoving;
  } else if (client.peer() >= 0 && client.replica() != nullptr) {
    now = State::kInside;
  }
  if (std::exchange(state_, now) == now) return "";
  const std::string server = ToString(client.server());
  if (now == State::kMoving) return "is sent on to " + server;
  if (now == State::kOutside) return "has lost " + server + " and tries to join again";
  const std::string again = std::exchange(was_inside_, true) ? "watches again: " : "watches ";
  return again + client.room().room + " at " + server + " as " + client.name();
}

}  // namespace seam
