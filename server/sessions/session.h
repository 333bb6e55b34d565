#pragma once
/// The server's record of one client.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/packed/states_packer.h"
#include "common/codec/packed/states_unpacker.h"
#include "common/net/link.h"
#include "common/net/net.h"
#include "common/sync/inputs/input_feed.h"
#include "common/sync/rest/rest_blocks.h"
#include "server/interest/send_queue.h"
#include "server/sessions/account_book.h"
#include "server/sessions/path_proof.h"
#include "server/sessions/traffic_budget.h"

namespace seam {

/// A goodbye is sent this often, each in a datagram of its own: a burst of losses, as of profile
/// 4g, easily takes four in a row.
constexpr int kByeCopies = 12;

enum class SessionStage {
  kAdmitted,  ///< has proved its address; is sent the Welcome and the Room
  kLoading,   ///< the last of the Room is on its way to the client
  kReady,     ///< simulates (or will from tick 0)
};

/// Identifies a sender of a Join: one address may hold several sessions.
struct SessionId {
  Address address;
  std::uint64_t number = 0;  ///< drawn by the client; another than that of the sealed session
  bool operator<(const SessionId& o) const {
    return address != o.address ? address < o.address : number < o.number;
  }
};

struct Session {
  /// `allowed`: limit for the client's traffic; `bytes_per_s`: limit for traffic to it, 0: none.
  Session(const SessionId& session, const SealKeys& keys, const TrafficRate& allowed,
          double bytes_per_s, const PackedMotion& motion)
      : id(session),
        address(session.address),
        link(keys),
        budget(allowed),
        send_queue(bytes_per_s),
        packer(motion),
        unpacker(motion) {
    send_queue.SetPath(link.rate().bytes_per_s(), false);
  }

  SessionId id;     ///< as it joined
  Address address;  ///< from where the newest datagram came
  PathProof path;   ///< to this address
  Link link;
  TrafficBudget budget;
  KindBudget kinds;                  ///< of messages by type
  std::vector<InputFeed> feeds;      ///< other players' inputs, by player
  std::vector<int> relevant_players;  ///< players with inputs relevant to the client, ascending
  std::vector<int> unsent_players;   ///< the ones with inputs that wait for another message
  std::vector<int> due_players;      ///< in Server::RelayInputs: the ones with new inputs
  SendQueue send_queue;              ///< states of other peers' bodies to send to the client
  RestBlocks rest;                   ///< comparison with the bodies that rest at the client
  bool rest_agrees = false;          ///< the same bodies rest at both, as of its newest ping
  ClientAccount* account = nullptr;  ///< the name's; outlives the session
  std::string name;
  int peer = 0;
  int player = -1;
  int revision = -1;  ///< edits that the client has applied, as of its newest ping
  float load = -1;    ///< share of the client's time spent in its ticks; below 0: not known
  SessionStage stage = SessionStage::kAdmitted;
  std::size_t room_sent = 0;  ///< bytes of the room that were given to the link
  std::int64_t created_us = 0;
  std::int64_t repaired_us = -1000000000;
  bool lapsed = false;  ///< its lease has ended: the client gets no authority until it joins anew
  /// Time from which its pings are no longer answered, because the client does not release a
  /// mechanism, us; -1: pings are answered.
  std::int64_t ending_us = -1;
  bool leaving = false;  ///< to be dropped at the next opportunity
  bool goodbye = false;  ///< the client itself said so
  std::string leaving_why;
  StatesPacker packer;      ///< states to send with the next flush
  StatesUnpacker unpacker;  ///< of the client's states

  /// Returns the load of the client's machine or, if greater, of the path to it; below 0: unknown.
  /// The planner takes a thin line as it takes a slow machine.
  float LoadAt(std::int64_t now_us) {
    const float line = send_queue.FollowedLoad(now_us);
    return line > 0 ? std::max(load, line) : load;
  }
};

}  // namespace seam
