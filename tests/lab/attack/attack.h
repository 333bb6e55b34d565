#pragma once
/// One session in which the first player's client lies, and what it wins.

#include <cstdint>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "tests/support/soak/fault_plan.h"

namespace seam {

struct AttackOutcome {
  std::int64_t lies = 0;         ///< changed states and messages
  std::int64_t first_tick = -1;  ///< of the first lie; -1: none
  std::int64_t acted_tick = -1;  ///< the server held the liar's bodies, or dropped it; -1: never
  int step = 0;                  ///< highest TrustStep of the liar
  int others_step = 0;           ///< highest TrustStep of all other players
  std::int64_t refused = 0;      ///< implausible states and messages, of all clients
  float highest_score = 0;       ///< of the liar's ladder
  float won = 0;                 ///< points of the liar at the end, if it won any by a lie
  float hurt = 0;                ///< health that other players' parts have lost
  int broken = 0;                ///< joints that are gone at the end
};

/// Returns the time from the first lie until the server acted, s at 60 ticks a second; 1e9: never.
inline double ActedAfterS(const AttackOutcome& outcome) {
  if (outcome.acted_tick < 0) return 1e9;
  return static_cast<double>(outcome.acted_tick - outcome.first_tick) / 60;
}

/// Runs the session with an attack of AttackNames(), and faults of the clients. Throws
/// OperatorError for an unknown one.
AttackOutcome RunAttack(ClusterConfig config, const std::string& attack,
                        const std::vector<Fault>& faults = {});

}  // namespace seam
