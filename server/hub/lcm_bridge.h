#pragma once
/// The server's end of a scene's [lcm]: takes messages of other programs for the scripts, and
/// publishes the poses of parts.

#include <cstdint>
#include <string>
#include <vector>

#include "common/record/lcm_inbox.h"
#include "common/sync/show/pose_publisher.h"
#include "server/server.h"

namespace seam {

class LcmBridge {
 public:
  /// Both must outlive it. Subscribes to the channels of [[lcm.message]].
  LcmBridge(Server& server, Bus& bus);

  /// Call before Server::Tick, with the same time: gives it the messages that have come.
  void Listen(std::int64_t now_us);
  /// Call after ticks: publishes the poses that are due.
  void Publish();
  /// Returns lines for the operator since the last call, about refused messages.
  std::vector<std::string> TakeReports() { return inbox_.TakeReports(); }

  /// Messages a second, and at once, on one channel: more than sensors have to say.
  static constexpr double kMessagesPerS = 200, kMessagesAtOnce = 32;

 private:
  Server& server_;
  Bus& bus_;
  LcmInbox inbox_;
  PosePublisher poses_;
};

}  // namespace seam
