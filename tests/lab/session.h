#pragma once
/// One session in virtual time as the command line says it: checked first, then run.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/base/limits.h"
#include "common/base/version.h"
#include "common/record/recorder.h"

namespace seam {

/// Version of the program's behaviour, for rows that must be comparable: "seam2d-" and the version.
inline const std::string kLabVersion = std::string("seam2d-") + kVersion;

/// All settings of a session; equal settings give equal bytes.
struct SessionSettings {
  std::string scene;  ///< path of a scene file
  std::string mode = "buffer";
  std::string reconcile;  ///< "": the mode's default
  std::string predict;    ///< "": the mode's default
  std::string impair = "demo";
  std::int64_t seed = 1;
  int send_hz = 30;              ///< at most the scene's tick_hz is used
  double duration_s = 0;         ///< after tick 0; 0: the scene's own
  std::string drive = "script";  ///< script | bot
  int players = 0;  ///< the first so many of the scene's join, the rest are absent; 0: all
  std::string publish = "all";   ///< for server and clients
  std::string smooth = "on";     ///< on | off | a rate, 1/s
  int show_age = -1;             ///< ticks; -1: the scene's
  std::vector<std::string> set;  ///< of the scene: "solver.substeps=2", "buffer=5"
};

/// Largest value of --seed, as seam-server's.
constexpr std::int64_t kSeedMax = 1000000000;

/// Reads the scene, with its settings, and checks all settings before anything is run or written.
/// Throws OperatorError. The recorder is not set.
ClusterConfig Configure(const SessionSettings& settings);
/// Like above, with the scene already read and its settings applied.
ClusterConfig Configure(const SessionSettings& settings, const Scene& scene);

struct SessionResult {
  double simulated_s = 0;  ///< virtual time, joining included
  std::int64_t ticks = 0;  ///< since tick 0
  std::vector<std::string> warnings;  ///< of the server: scripts that were stopped, and the like
  bool script_stopped = false;
};

/// Throws OperatorError if a script was stopped: figures of such a room are those of another room.
void RequireScripts(Server& server);
void RequireScripts(const SessionResult& result);

/// Called now and then: ticks done, and in all.
using TicksDone = std::function<void(std::int64_t, std::int64_t)>;

/// Runs to the end; the recording, if wanted and kept, goes to `recording`. Throws OperatorError
/// when the players cannot join over such a network.
SessionResult RunSession(const ClusterConfig& config, Recording* recording = nullptr,
                         const TicksDone& progress = nullptr);

}  // namespace seam
