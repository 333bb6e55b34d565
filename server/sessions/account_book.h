#pragma once
/// Traffic and connection statistics per client name, for people; kept after a session is over.

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace seam {

/// Datagrams and messages that were dropped, by reason (stats_t).
struct DropCount {
  std::int64_t malformed = 0, stale = 0, right = 0, implausible = 0, budget = 0;
  std::int64_t total() const { return malformed + stale + right + implausible + budget; }
};

/// Totals of all sessions under one name.
struct ClientAccount {
  std::string name;
  int peer = 0;                                 ///< the newest session's
  int player = -1;                              ///< that it drives; -1: a spectator
  int sessions = 0;                             ///< sessions that became ready
  int rejoins = 0;                              ///< of these, after an earlier one
  bool known = false;                           ///< was in the room, or in the one gone on with
  std::int64_t hand_overs = 0;                  ///< changes of authority to it
  std::int64_t bytes_in = 0, bytes_out = 0;     ///< UDP payload
  DropCount dropped;                            ///< datagrams and messages from it
  std::int64_t corrections = 0;                 ///< corrections of the server's copy of its bodies
  std::int64_t readings = 0;                    ///< readings of round trip and loss, one a second
  std::int64_t rtt_us_sum = 0, rtt_us_max = 0;  ///< over the readings
  std::int64_t loss_ppm_sum = 0;                ///< on the way to the server, over the readings

  /// Became ready, was heard again after a silence, or was last found to hear nothing; -1: never.
  std::int64_t returned_us = -1;

  /// Counts a session that became ready after `tick` (change 1), or that left (-1).
  void NotePresent(std::int64_t tick, int change);
  /// Ticks in the room up to this one, over all sessions.
  std::int64_t PresentTicks(std::int64_t tick) const;
  /// Means over the readings; -1: no reading.
  std::int64_t rtt_us() const { return readings > 0 ? rtt_us_sum / readings : -1; }
  std::int64_t loss_ppm() const { return readings > 0 ? loss_ppm_sum / readings : -1; }
  /// Adds a reading. Ignored if `read_rtt_us` is -1: not known yet.
  void Read(std::int64_t read_rtt_us, std::int64_t read_loss_ppm);

 private:
  int present_ = 0;  // sessions in the room
  std::int64_t present_ticks_ = 0, present_since_ = 0;
};

class AccountBook {
 public:
  /// Most accounts. When all but one are taken, every further name shares the account "others", so
  /// that no number of names fills the memory.
  static constexpr std::size_t kAccountsMax = 1024;

  /// Returns the account of a name; makes it if needed. The reference stays valid.
  ClientAccount& Of(const std::string& name);
  /// Returns all accounts, ordered by peer, then by name.
  std::vector<ClientAccount> List() const;

 private:
  std::map<std::string, ClientAccount> accounts_;
};

}  // namespace seam
