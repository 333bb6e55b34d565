#pragma once
/// Loads logs as playbacks, each with its oracle.

#include <vector>

#include "render/options.h"
#include "render/playback/playback.h"

namespace seam {

/// Reads options.logs. The oracle is options.oracle, or the log itself if it was made in mode
/// oracle, or is computed from the recorded inputs. Shows progress on a terminal. Throws
/// OperatorError for a log without views.
std::vector<Playback> LoadPlaybacks(const RenderOptions& options);

/// One log and its oracle, chosen as by LoadPlaybacks.
struct LoadedLog {
  Recording recording;
  std::optional<Oracle> oracle;
};
LoadedLog LoadLog(const RenderOptions& options, std::size_t i);

/// Returns the files that are read, which no output may replace.
std::vector<std::string> ReadBy(const RenderOptions& options);

/// Reads the recording of options.logs[i], without an oracle.
Recording ReadLog(const RenderOptions& options, std::size_t i);

/// An oracle made of a log of mode oracle, with the log's room.
struct GivenOracle {
  std::string path;
  Room room;
  Oracle oracle;
};

/// Reads a log of mode oracle. Throws OperatorError when the log has another mode.
GivenOracle LoadOracle(const std::string& path);

/// Returns the peer that drives a player of this name, or the server for "server". Throws
/// OperatorError with the existing names.
int PeerNamed(const Playback& playback, const std::string& name);

/// Throws OperatorError with the existing peers when `peer` has no views, except in mode oracle.
void RequirePeer(const Playback& playback, int peer);

}  // namespace seam
