#pragma once
/// A relay's record of one watcher.

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/net/link.h"
#include "common/net/send_credit.h"
#include "common/sync/rest/rest_blocks.h"
#include "server/relay/shared_states.h"
#include "server/sessions/path_proof.h"
#include "server/sessions/session.h"
#include "server/sessions/traffic_budget.h"

namespace seam {

struct Watcher {
  Watcher(const SessionId& session, const SealKeys& keys, const TrafficRate& allowed)
      : id(session), address(session.address), link(keys), budget(allowed) {}

  SessionId id;     ///< as it joined
  Address address;  ///< from where the newest datagram came
  PathProof path;   ///< to this address
  Link link;
  TrafficBudget budget;
  SendCredit credit;  ///< for the path to it
  SentStates states;
  RestBlocks rest;           ///< comparison with the bodies at rest here
  bool rest_agrees = false;  ///< as of its newest ping
  std::string name;
  SessionStage stage = SessionStage::kAdmitted;
  std::size_t room_sent = 0;  ///< bytes of the room that were given to the link
  std::int64_t created_us = 0;
  std::int64_t repaired_us = -1000000000;
  bool says_ready = false;  ///< has loaded the room, maybe before the world was sent
  bool leaving = false;     ///< to be dropped at the next opportunity
};

}  // namespace seam
