#pragma once
/// The faults of one session, drawn from its seed: the network, and the faults of each client with
/// their times.

#include <cstdint>
#include <string>
#include <vector>

#include "client/embed/cluster.h"

namespace seam {

enum class FaultKind {
  kCut,     ///< nothing passes between it and the server
  kPause,   ///< its process is stopped
  kSlowed,  ///< it is run only now and then
  kKill,    ///< its process dies, and another begins later
  kLeave,   ///< it says goodbye, and comes back later
  kMove,    ///< its address changes
  kServer,  ///< the server dies, and another goes on with its room later; client is -1
};
const char* ToString(FaultKind kind);

struct Fault {
  FaultKind kind = FaultKind::kCut;
  int client = 0;
  double from_s = 0, to_s = 0;  ///< of the room's time
  std::int64_t every_us = 0;    ///< kSlowed: from one run to the next
};

struct FaultPlan {
  ClusterConfig config;       ///< without `client_net`
  std::vector<Fault> faults;  ///< of one client one after the other
  std::string name;           ///< all of it in a line, for people
};

/// The last faults are over so long before the end, s.
constexpr double kCalmSeconds = 10;

/// Range from which sessions are drawn.
struct FaultChoice {
  std::vector<std::string> scenes;
  double seconds = 20;
  int players = 8;  ///< at most so many of the scene's are there
  /// In half of the sessions the limits are so low that a small room behaves like a large one: no
  /// client follows it whole, and in some sessions clients get few bytes.
  bool narrow = false;
};

/// Adds deaths of the server, and clients whose address changes. The same seed adds the same.
void AddServerFaults(std::uint64_t seed, double seconds, FaultPlan* plan);
/// Draws a session. The same seed and choice draw the same.
FaultPlan DrawFaults(std::uint64_t seed, const FaultChoice& choice);

}  // namespace seam
