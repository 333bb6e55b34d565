#pragma once
/// From logs to playbacks, with the oracle that belongs to each.

#include <vector>

#include "render/options.h"
#include "render/playback/playback.h"

namespace seam {

/// Reads options.logs; the oracle is options.oracle's, or the log's own if it was made in mode
/// oracle, or computed from the recorded inputs. Says on a terminal how far it is. Throws
/// OperatorError for a log without views.
std::vector<Playback> LoadPlaybacks(const RenderOptions& options);

/// One log and its oracle, as LoadPlaybacks has them.
struct LoadedLog {
  Recording recording;
  std::optional<Oracle> oracle;
};
LoadedLog LoadLog(const std::string& path, const RenderOptions& options);

/// The displayed path of a log made in mode oracle, and the room it was made in.
struct GivenOracle {
  std::string path;
  Room room;
  Oracle oracle;
};

/// Throws OperatorError when the log is another mode's.
GivenOracle LoadOracle(const std::string& path);

/// The peer that is the server, "server", or drives a player of this name. Throws OperatorError
/// naming those there are.
int PeerNamed(const Playback& playback, const std::string& name);

/// Throws OperatorError naming the peers there are when `peer` showed nothing.
void RequirePeer(const Playback& playback, int peer);

}  // namespace seam
