#pragma once
/// Saves a room while it runs: a snapshot at a barrier each kSnapshotS, copied in the tick and
/// written by the recording's DiskThread.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/record/sink.h"

namespace seam {

class Server;

/// Time between two snapshots, s: as much is stepped again when the room is resumed.
constexpr int kSnapshotS = 5;

class RoomKeeper {
 public:
  /// Keeps the room in `folder`. Its log must go to `sink`, which must outlive this. `keep_s`: see
  /// RemoveOldSegments; 0: all is kept.
  RoomKeeper(std::string folder, std::string room, Sink& sink, std::int32_t epoch = 1,
             std::int64_t keep_s = 0);

  /// Call after each Server::Tick that has stepped. Saves the room if that is due and possible:
  /// rooms go back to barriers, and only at these saving changes nothing.
  void AfterTick(Server& server, std::int64_t now_us);
  /// Saves the room as it begins here. It is with the operating system then, as the log is; the
  /// DiskThread waits for the disk.
  void Begin(Server& server, std::int64_t now_us);
  /// Saves the room as it is, and waits until it is written.
  void Finish(Server& server, std::int64_t now_us);

  /// Returns the first failure to write a snapshot.
  Status trouble() const;
  /// Returns the lines for the operator since the last call: old segments were removed.
  std::vector<std::string> TakeNews();
  /// Longest time that a snapshot took in a tick, us, and bytes of the last one.
  std::int64_t longest_us() const { return longest_us_; }
  std::size_t bytes() const { return shared_->bytes; }

 private:
  /// What the thread uses, maybe after this object.
  struct Shared {
    std::mutex mutex;  // guards trouble and news
    Status trouble;
    std::vector<std::string> news;
    std::atomic<bool> writing{false};
    std::atomic<std::size_t> bytes{0};  // of the last snapshot
  };
  void Save(Server& server, std::int64_t now_us);

  const std::string folder_, room_;
  Sink& sink_;
  const std::int32_t epoch_;  // of the log
  const std::int64_t keep_s_;
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::int64_t next_tick_ = 0;
  std::int64_t longest_us_ = 0;
  std::size_t copied_bytes_ = 0;  // of the last copy
};

}  // namespace seam
