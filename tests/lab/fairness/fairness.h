#pragma once
/// Momentum that each player receives in a mirrored crash between a player near the server and one
/// far from it. docs/metrics.md, "Fairness".

#include <array>
#include <cstdint>
#include <string>

#include "tests/lab/session.h"

namespace seam {

struct FairnessRun {
  SessionSettings session;  ///< scene, mode, seed ...; two players with a vehicle each. `impair` is
                            ///< not looked at: the network is each player's own
  int near = 0;             ///< which of the two players is near, 0 or 1
  std::string near_path = "delay=20ms,jitter=5ms";  ///< either way
  std::string far_path = "delay=120ms,jitter=5ms";
  bool random = false;  ///< both do the same at random, by the seed, instead of their scripts
};

/// Momentum that each player's car loses in the crash, along x towards the other car, N s.
struct FairnessResult {
  std::string invalid;     ///< why there is no result, in one line; empty: there is one
  std::int64_t crash = 0;  ///< tick of it in the oracle
  double closing_mps = 0;  ///< before it, in the oracle
  double oracle_ns = 0;    ///< mean of the two
  // By [0: near, 1: far], as displayed.
  std::array<double, 2> own_ns{};     ///< of the player's own car on the player's own screen
  std::array<double, 2> server_ns{};  ///< of the same car at the server

  /// Momentum that the far player received more than the near one.
  double advantage_own_ns() const { return own_ns[1] - own_ns[0]; }
  double advantage_server_ns() const { return server_ns[1] - server_ns[0]; }
};

/// Runs it in virtual time. Throws OperatorError for a scene without two vehicles, an unknown mode
/// or network, or when the players cannot join.
FairnessResult RunFairness(const FairnessRun& run);

/// The same of a recording that is there already.
FairnessResult JudgeFairness(const Recording& recording, int near);

}  // namespace seam
