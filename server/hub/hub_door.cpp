#include "server/hub/hub_door.h"

#include "common/base/hex.h"
#include "common/base/process.h"

namespace seam {

HubDoor::HubDoor(std::uint16_t port, Hub& hub)
    : server_(port),
      token_(SecretDigits(entropy_)),
      door_(
          token_,
          [&hub](const std::string& command) {
            return hub.rooms()[0]->Control(SteadyClockUs(), command);
          },
          [&hub] { return hub.rooms()[0]->ControlJson(); }) {}

std::string HubDoor::address() const {
  return "http://127.0.0.1:" + std::to_string(server_.port()) + "/control?token=" + token_;
}

void HubDoor::Poll(std::int64_t now_us) {
  if (now_us - polled_us_ < kDoorUs) return;
  polled_us_ = now_us;
  server_.Poll(now_us, [&](const HttpRequest& request) { return door_.Answer(now_us, request); });
}

}  // namespace seam
