#include "render/load.h"

#include "common/base/check.h"
#include "common/base/nearest.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "common/record/damage.h"
#include "common/sync/method.h"
#include "render/compared.h"
#include "render/scene_recording.h"

namespace seam {

std::vector<std::string> ReadBy(const RenderOptions& options) {
  std::vector<std::string> read = options.logs;
  if (!options.oracle.empty()) read.push_back(options.oracle);
  return read;
}

Recording ReadLog(const RenderOptions& options, std::size_t i) {
  Recording recording = ReadRecording(options.logs[i], options.room,
                                      options.sessions.empty() ? "" : options.sessions[i]);
  ReportDamage("seam-render", options.logs[i], recording);
  return recording;
}

LoadedLog LoadLog(const RenderOptions& options, std::size_t i) {
  const std::string& path = options.logs[i];
  Recording recording = ReadLog(options, i);
  const std::string sessions = ChosenSession(recording);
  if (!sessions.empty()) PrintError("seam-render", "note: " + path + ": " + sessions);
  if (recording.views.empty() || recording.last_tick < recording.first_tick)
    throw OperatorError(path + ": the recording has no views, so there is nothing to draw");
  if (recording.room.tick_hz < 1) throw OperatorError(path + ": the room's tick rate is missing");
  std::optional<Oracle> oracle;
  if (!options.oracle.empty()) {
    GivenOracle truth = LoadOracle(options.oracle);
    RequireOracleOf(truth.room, truth.path, recording.room, path);
    oracle = std::move(truth.oracle);
  } else if (PolicyOf(recording.room).IsOracle()) {
    oracle = OracleFromRecording(recording);
  } else if (const std::string why = WhyNoOracle(recording); !why.empty()) {
    PrintError("seam-render", "note: " + path + ": no oracle and no errors: " + why);
  } else {
    oracle = ComputeOracle(recording, JudgeOf(recording.room));
  }
  return {std::move(recording), std::move(oracle)};
}

std::vector<Playback> LoadPlaybacks(const RenderOptions& options) {
  std::vector<Playback> playbacks;
  ProgressCount count("reading", "recordings", static_cast<std::int64_t>(options.logs.size()));
  for (std::size_t i = 0; i < options.logs.size(); ++i) {
    const std::string& path = options.logs[i];
    count(static_cast<std::int64_t>(i));
    if (IsSceneFile(path)) {
      playbacks.emplace_back(RecordingOfScene(path), std::nullopt);
      continue;
    }
    LoadedLog log = LoadLog(options, i);
    playbacks.emplace_back(std::move(log.recording), std::move(log.oracle));
  }
  std::vector<const Playback*> runs;
  for (const Playback& playback : playbacks) runs.push_back(&playback);
  RequireOneScene(options.logs, runs);
  const std::vector<std::string> apart = ApartOf(options.logs, runs);
  for (std::size_t i = 0; i < apart.size(); ++i) playbacks[i].SetApart(apart[i]);
  return playbacks;
}

GivenOracle LoadOracle(const std::string& path) {
  const Recording recording = ReadRecording(path);
  ReportDamage("seam-render", path, recording);
  RequireOracleOf(recording.room, path, recording.room, path);  // checks the mode alone
  return {path, recording.room, OracleFromRecording(recording)};
}

int PeerNamed(const Playback& playback, const std::string& name) {
  std::string list;
  std::vector<std::string> known;
  for (const int peer : playback.peers()) {
    const int player = playback.PlayerOf(peer);
    std::string own = "server";
    if (peer > 0) {
      own = player < 0 ? std::to_string(peer)
                       : playback.scene().players[static_cast<std::size_t>(player)].name;
    }
    if (own == name) return peer;
    list += (list.empty() ? "" : ", ") + own;
    known.push_back(own);
  }
  throw OperatorError("--view " + name + ": the recording has views of " + list +
                      DidYouMean(name, known));
}

void RequirePeer(const Playback& playback, int peer) {
  if (playback.PeerOr(peer) == peer || playback.policy().IsOracle()) return;
  std::string known;
  for (int p : playback.peers()) known += (known.empty() ? "" : ", ") + std::to_string(p);
  throw OperatorError("--view " + std::to_string(peer) + ": the recording has views of " + known);
}

}  // namespace seam
