#include "client/embed/local_session.h"

#include "common/base/check.h"

namespace seam {
namespace {

/// Largest seed, as of seam-server.
constexpr std::int64_t kSessionSeedMax = 1000000000;

Drive DriveOf(const std::string& name) {
  if (name == "inputs") return Drive::kLive;
  if (name == "script") return Drive::kScript;
  if (name == "bot") return Drive::kBot;
  throw OperatorError("no drive \"" + name + "\"; there are inputs, script and bot");
}

void RequireWithin(const char* name, std::int64_t value, std::int64_t least, std::int64_t most) {
  if (value >= least && value <= most) return;
  throw OperatorError(std::string(name) + " is " + std::to_string(value) + ", not from " +
                      std::to_string(least) + " to " + std::to_string(most));
}

/// Returns the drive. Throws OperatorError for a number out of range or a drive that does not
/// exist.
Drive RequireSane(const LocalSessionConfig& config) {
  RequireWithin("seed", config.seed, 0, kSessionSeedMax);
  RequireWithin("send_hz", config.send_hz, 1, kSendHzMax);
  return DriveOf(config.drive);
}

ClusterConfig ClusterOf(const LocalSessionConfig& config, Recorder* log) {
  ClusterConfig cluster;
  cluster.mode = config.mode;
  cluster.reconcile = config.reconcile;
  cluster.predict = config.predict;
  cluster.impair = config.impair;
  cluster.seed = config.seed;
  cluster.send_hz = config.send_hz;
  cluster.drive = DriveOf(config.drive);
  cluster.shows = true;
  cluster.keep = config.keep;
  cluster.recorder = log;
  return cluster;
}

std::unique_ptr<RoomLog> LogOf(const LocalSessionConfig& config) {
  if (config.record.empty()) return nullptr;
  return std::make_unique<RoomLog>(config.record, config.force, nullptr);
}

}  // namespace

LocalSession::LocalSession(const Scene& scene, const LocalSessionConfig& config)
    : drive_(RequireSane(config)),
      log_(LogOf(config)),
      cluster_(ClusterOf(config, log_.get()), scene) {
  cluster_.each_instant = [this] {
    for (int i = 0; i < client_count(); ++i)
      if (!client(i).fatal().empty())
        throw OperatorError(client(i).name() + ": " + client(i).fatal());
  };
}

LocalSession::~LocalSession() {
  if (log_ != nullptr) cluster_.server().Shutdown(cluster_.now_us(), "the session is over");
}

void LocalSession::RunToTick(std::int64_t tick) {
  cluster_.RunToTick(tick);
  RequireLog();
}

void LocalSession::SetInput(int player, const Input& input) {
  if (drive_ != Drive::kLive)
    throw OperatorError("this session is driven by a script or bots, not by inputs");
  if (player < 0 || player >= client_count()) {
    throw OperatorError("there is no player " + std::to_string(player) + ": the scene has " +
                        std::to_string(client_count()));
  }
  cluster_.client(player)->SetLiveInput(input);
}

View LocalSession::ViewOf(int peer) const {
  if (peer < 0 || peer > client_count()) {
    throw OperatorError("there is no peer " + std::to_string(peer) + ": 0 is the server, clients " +
                        "are 1 to " + std::to_string(client_count()));
  }
  if (peer == 0) return server().replica().MakeView();
  const Client& from = client(peer - 1);
  return from.running() ? from.replica()->MakeView() : View();
}

void LocalSession::Flush() {
  if (log_ != nullptr) log_->Flush();
  RequireLog();
}

void LocalSession::RequireLog() const {
  if (log_ != nullptr && !log_->trouble().ok()) throw OperatorError(log_->trouble().why());
}

}  // namespace seam
