#pragma once
/// The log and the snapshots of a cluster's room, as seam-server --state keeps them, for a server
/// that is killed and goes on.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/embed/cluster.h"
#include "common/record/room_log.h"

namespace seam {

class KeptLog : public Recorder {
 public:
  /// Writes its files into a temporary folder.
  KeptLog();
  ~KeptLog() override;

  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override;

  /// Takes a snapshot when that is due. To be called after every virtual instant.
  void Look(Cluster& cluster);
  /// Kills the server; another goes on with what is in the log. Returns false, and does nothing,
  /// before the first snapshot. Each third time the newest snapshot is taken for damaged. `broken`
  /// gets a line for each accepted thing that is lost.
  bool Restart(Cluster& cluster, std::int64_t down_us, std::vector<std::string>* broken);

  /// Time between snapshots, s.
  static constexpr int kSnapshotEveryS = 5;

 private:
  std::string folder_, path_;
  std::unique_ptr<RoomLog> log_;
  struct Saved {
    std::int64_t tick = 0;
    LogPlace place;
    Bytes room;
  };
  std::vector<Saved> saved_;  // the last two snapshots, ascending
  int files_ = 0;
};

}  // namespace seam
