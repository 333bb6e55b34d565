/// Asks a server for its room before a swarm joins.

#include "client/swarm/swarm.h"
#include "common/base/check.h"
#include "common/base/process.h"

namespace seam {
namespace {

/// Time without an answer, or without more of the room, us.
constexpr std::int64_t kPatienceOfAskUs = 10000000;

}  // namespace

Room AskForRoom(const Address& server, const std::string& room) {
  ClientConfig config;
  config.server = server;
  config.name = "swarm-scout";
  config.room = room;
  config.watch = true;
  config.publish = Publish::kNone;
  config.smooth_rate = 0;
  Group group;
  group.Add(config, false);
  const Client& scout = group.members()[0]->client();
  std::int64_t begin_us = SteadyClockUs();
  double share = 0;
  while (scout.replica() == nullptr && scout.fatal().empty() && g_stop == 0) {
    if (scout.room_share() > share) begin_us = SteadyClockUs();
    share = scout.room_share();
    if (SteadyClockUs() - begin_us > kPatienceOfAskUs) {
      throw OperatorError("no answer from " + ToString(server) + " within 10 s");
    }
    group.Run(SteadyClockUs() + 5000);
  }
  if (!scout.fatal().empty()) throw OperatorError(scout.fatal());
  if (scout.replica() == nullptr) throw OperatorError("stopped before anybody had joined");
  const Room found = scout.room();
  group.Leave(SteadyClockUs());
  return found;
}

}  // namespace seam
