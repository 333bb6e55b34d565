#include "tests/lab/session.h"

#include "common/base/check.h"
#include "common/sync/method.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

Drive ParseDrive(const std::string& drive) {
  if (drive == "script") return Drive::kScript;
  if (drive == "bot") return Drive::kBot;
  throw OperatorError("no drive \"" + drive + "\"; there are script and bot");
}

void CheckRange(const char* name, double value, double min, double max) {
  if (value >= min && value <= max) return;  // false for NaN
  throw OperatorError(std::string(name) + " " + std::to_string(value) + " is not within " +
                      std::to_string(min) + " and " + std::to_string(max));
}

}  // namespace

ClusterConfig Configure(const SessionSettings& settings) {
  return Configure(settings, LoadSceneWith(settings.scene, settings.set));
}

ClusterConfig Configure(const SessionSettings& settings, const Scene& scene) {
  CheckRange("seed", static_cast<double>(settings.seed), 0, static_cast<double>(kSeedMax));
  CheckRange("send_hz", settings.send_hz, 1, kSendHzMax);
  CheckRange("players", settings.players, 0, kPlayersMax);
  if (settings.players > static_cast<int>(scene.players.size())) {
    throw OperatorError("--players " + std::to_string(settings.players) + ": " + scene.name +
                        " has " + std::to_string(scene.players.size()) + " player(s)");
  }
  CheckRange("duration", settings.duration_s, 0, kDurationMax);
  MakeSyncConfig(MethodNames{settings.mode, settings.reconcile, settings.predict});
  FindProfile(settings.impair);
  if (settings.impair.size() > kImpairBytesMax) {
    throw OperatorError("the network profile is longer than " + std::to_string(kImpairBytesMax) +
                        " bytes: recordings could not name it");
  }
  ClusterConfig config;
  config.scene = settings.scene;
  config.scene_text = scene.text;
  config.mode = settings.mode;
  config.reconcile = settings.reconcile;
  config.predict = settings.predict;
  config.impair = settings.impair;
  config.seed = settings.seed;
  config.duration_s = settings.duration_s;
  config.drive = ParseDrive(settings.drive);
  config.players = settings.players;
  config.publish = ParsePublish(settings.publish);
  config.send_hz = settings.send_hz;
  config.smooth_rate = ParseSmoothRate(settings.smooth);
  if (settings.show_age >= 0) config.show_age_ticks = settings.show_age;
  return config;
}

void RequireScripts(Server& server) {
  if (server.script_stopped()) throw OperatorError(server.TakeWarnings().front());
}

void RequireScripts(const SessionResult& result) {
  if (result.script_stopped) throw OperatorError(result.warnings.front());
}

SessionResult RunSession(const ClusterConfig& config, Recording* recording,
                         const TicksDone& progress) {
  Cluster cluster(config);
  const Scene& scene = cluster.scene();
  const double seconds = config.duration_s > 0 ? config.duration_s : scene.duration_s;
  const auto ticks = static_cast<std::int64_t>(seconds * scene.solver.tick_hz);
  if (progress) cluster.each_instant = [&] { progress(cluster.server().tick(), ticks); };
  const std::int64_t begin_us = cluster.now_us();
  cluster.Run();
  SessionResult result;
  result.simulated_s = static_cast<double>(cluster.now_us() - begin_us) * 1e-6;
  result.ticks = cluster.server().tick();
  cluster.server().Shutdown(cluster.now_us(), "the time is over");
  result.warnings = cluster.server().TakeWarnings();
  result.script_stopped = cluster.server().script_stopped();
  if (recording != nullptr && config.keep) *recording = cluster.recording();
  return result;
}

}  // namespace seam
