#pragma once
/// Sessions with faults of clients, networks and the server, in virtual time: a seed draws a scene,
/// a method, a network and all faults, and the invariants hold at every instant.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

struct ChaosChoice {
  std::vector<std::string> scenes;  ///< empty: those of scenes/ with at most 8 players
  double seconds = 60;              ///< the last 10 are without faults
};

struct ChaosOutcome {
  std::string name;                 ///< the session, in a line
  std::vector<std::string> broken;  ///< violated invariants, a line each
  int restarts = 0;                 ///< of the server
};

/// Returns the command that runs the session of a seed alone.
std::string CommandOf(std::uint64_t seed, const ChaosChoice& choice);

/// Runs the session of a seed. The same seed and choice run the same.
ChaosOutcome RunChaos(std::uint64_t seed, const ChaosChoice& choice);

}  // namespace seam
