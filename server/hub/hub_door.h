#pragma once
/// The operator's door to the only room of a hub: on this machine, with a token.

#include <cstdint>
#include <string>

#include "common/base/entropy.h"
#include "common/net/http_server.h"
#include "server/control/control_door.h"
#include "server/hub/hub.h"

namespace seam {

class HubDoor {
 public:
  /// Opens the door at `port` (0: any). `hub` must outlive it; requires one room, that is run by
  /// the hub's own thread and has RoomPlan::control. Throws OperatorError if the port is in use.
  HubDoor(std::uint16_t port, Hub& hub);

  /// Returns the address with the token, another at each start.
  std::string address() const;
  /// Answers without waiting, each kDoorUs. Call it often.
  void Poll(std::int64_t now_us);

  /// More often costs system calls; more seldom makes a dragged body late.
  static constexpr std::int64_t kDoorUs = 2000;

 private:
  HttpServer server_;
  OsEntropy entropy_;
  const std::string token_;
  ControlDoor door_;
  std::int64_t polled_us_ = 0;
};

}  // namespace seam
