#pragma once
/// What the server knows of one client.

#include <cstdint>
#include <string>
#include <vector>

#include "common/codec/packed/states_packer.h"
#include "common/net/link.h"
#include "common/net/net.h"
#include "common/sync/input_feed.h"
#include "common/sync/rest/rest_blocks.h"
#include "server/interest/outbox.h"
#include "server/sessions/account_book.h"
#include "server/sessions/traffic_budget.h"

namespace seam {

enum class SessionStage {
  kAdmitted,  ///< has proved its address; the Welcome waits, and the Room comes next
  kLoading,   ///< the Room is under way
  kReady,     ///< simulates (or will from tick 0)
};

/// Who sends: one address may hold several conversations.
struct SessionId {
  Address address;
  std::uint64_t number = 0;  ///< drawn by the client
  bool operator<(const SessionId& o) const {
    return address != o.address ? address < o.address : number < o.number;
  }
};

struct Session {
  /// `bytes_per_s`: what it is sent at most; 0: no limit.
  Session(const SessionId& session, const TrafficRate& allowed, double bytes_per_s,
          const PackedMotion& motion)
      : id(session), link(session.number), budget(allowed), outbox(bytes_per_s), packer(motion) {}

  SessionId id;
  Link link;
  TrafficBudget budget;
  std::vector<InputFeed> feeds;      ///< of the others' inputs, by player
  std::vector<int> heard_players;    ///< whose inputs concern it, ascending
  std::vector<int> unsent_players;   ///< of them, of whom something waits to go along with others
  Outbox outbox;                     ///< states of others that wait for it
  RestBlocks rest;                   ///< with what the client knows to rest
  bool rest_agrees = false;          ///< all of it, as of its newest ping
  ClientAccount* account = nullptr;  ///< the name's; outlives the session
  std::string name;
  int peer = 0;
  int player = -1;
  int revision = -1;  ///< edits that it has applied, as of its newest ping
  float load = -1;    ///< share of its time that it needs for its ticks; below 0: not known
  SessionStage stage = SessionStage::kAdmitted;
  std::int64_t created_us = 0;
  std::int64_t repaired_us = -1000000000;
  bool lapsed = false;  ///< its lease has ended: it gets no authority before it joins anew
  /// Since when its pings are not answered, us, because it does not let go; -1: they are.
  std::int64_t ending_us = -1;
  bool leaving = false;  ///< to be dropped at the next opportunity
  bool goodbye = false;  ///< it said so itself
  std::string leaving_why;
  StatesPacker packer;  ///< states that go out with the next flush
};

}  // namespace seam
