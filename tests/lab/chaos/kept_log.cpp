#include "tests/lab/chaos/kept_log.h"

#include <cstdlib>
#include <filesystem>
#include <map>

#include "common/base/check.h"
#include "server/rules/rules.h"
#include "server/saved/snapshot_file.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// The accepted record of a room: it must be the same after a restart.
struct Accepts {
  std::int64_t tick = 0;
  int revision = 0;
  std::uint64_t composition = 0;
  std::map<MetaKey, float> values;

  explicit Accepts(const Server& server)
      : tick(server.tick()),
        revision(server.replica().revision()),
        composition(server.replica().world().composition().hash) {
    if (server.rules() != nullptr) values = server.rules()->metadata().values();
  }
};

}  // namespace

KeptLog::KeptLog() : folder_((fs::temp_directory_path() / "seam-chaos-XXXXXX").string()) {
  if (mkdtemp(folder_.data()) == nullptr) throw OperatorError(folder_ + ": cannot be made");
  path_ = folder_ + "/0.lcm";
  log_ = std::make_unique<RoomLog>(path_, false, nullptr);
}

KeptLog::~KeptLog() {
  log_.reset();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void KeptLog::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (PublisherOfChannel(channel) == 0) log_->Publish(channel, utime, message);
}

void KeptLog::EndTick(const std::string& channel, const LogSeal& seal, bool kept) {
  if (seal.peer == 0) log_->EndTick(channel, seal, kept);
}

void KeptLog::Look(Cluster& cluster) {
  Server& server = cluster.server();
  const std::int64_t every = kSnapshotEveryS * cluster.scene().solver.tick_hz;
  if (!server.started() || server.tick() < 1 || server.tick() % every != 0) return;
  if (!saved_.empty() && server.tick() == saved_.back().tick) return;
  const LogPlace place = log_->Pin();
  saved_.push_back({server.tick(), place, server.Save(cluster.now_us())});
  if (saved_.size() > static_cast<std::size_t>(kSnapshotsKept)) saved_.erase(saved_.begin());
}

bool KeptLog::Restart(Cluster& cluster, std::int64_t down_us, std::vector<std::string>* broken) {
  if (saved_.empty()) return false;
  const Saved& from = files_ % 3 == 2 ? saved_.front() : saved_.back();
  const Accepts was(cluster.server());
  // A killed process writes nothing more: another file has what was written.
  const std::string path = folder_ + "/" + std::to_string(++files_) + ".lcm";
  fs::copy_file(path_, path);
  LogTail tail;
  Status status =
      ReadLogTail(path, cluster.server().room().room, from.place, from.tick, nullptr, &tail);
  if (status.ok() && !tail.damage.empty()) status = Status::Error(tail.damage);
  std::unique_ptr<const SavedRoom> saved;
  if (status.ok()) saved = SavedRoom::Read(from.room, &status);
  if (!status.ok()) throw OperatorError(status.why());
  log_ = std::make_unique<RoomLog>(path, tail.end, nullptr);
  path_ = path;
  cluster.RestartServer(*saved, tail, down_us);
  const Accepts is(cluster.server());
  const std::string at = "at tick " + std::to_string(was.tick) + ": ";
  if (is.tick != was.tick) broken->push_back(at + "goes on after tick " + std::to_string(is.tick));
  if (is.revision != was.revision) broken->push_back(at + "accepted edits are lost");
  if (is.composition != was.composition) broken->push_back(at + "another composition");
  if (is.values != was.values) broken->push_back(at + "accepted values are lost");
  return true;
}

}  // namespace seam
