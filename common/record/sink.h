#pragma once
/// The recorder configured by `--lcm-url` and `--record`: a bus, a log file, both or none.

#include <map>
#include <memory>
#include <string>

#include "common/record/bus.h"
#include "common/record/disk_thread.h"
#include "common/record/room_log.h"

namespace seam {

/// Publishes to the bus (unless `lcm_url` is "none") and writes `record_path` (unless empty). With
/// both, the log also contains the messages of the room's other peers, as lcm-logger would have
/// written it. The log begins with the first message published here: a program that ends before
/// creates no file and overwrites none. If the file cannot be created then, recording is given up,
/// because a log without its beginning has no scene.
class Sink : public Recorder {
 public:
  /// `log_key` (null: none) and `segment_bytes`: of the log, see RoomLog. Throws OperatorError from
  /// Bus, or if the file cannot be written.
  Sink(const std::string& lcm_url, const std::string& record_path, bool force,
       const std::string& room, std::shared_ptr<const Secret> log_key = nullptr,
       std::int64_t segment_bytes = 0);
  /// Goes on with the log at a place, see RoomLog.
  Sink(const std::string& lcm_url, const std::string& record_path, const LogPlace& place,
       const std::string& room, std::shared_ptr<const Secret> log_key = nullptr,
       std::int64_t segment_bytes = 0);

  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  void Repeat(const std::string& channel, std::int64_t utime, ByteView message) override {
    if (bus_ != nullptr) bus_->Repeat(channel, utime, message);
  }
  /// Ends the tick on the bus and in the log, which is then with the operating system.
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override;
  std::int64_t failures() const override;
  bool listening() const override { return bus_ != nullptr || !record_path_.empty(); }
  /// Returns the first failure to write the log; ok if there is none, or no log.
  const Status& trouble() const;
  /// Handles the messages of other programs that have come on the bus: copies those of the room's
  /// peers into the log. Call it often; never blocks.
  void Poll();
  /// Returns the bus; null without one.
  Bus* bus() { return bus_.get(); }
  /// Passes the log to the operating system, so that failures() includes a full disk.
  void Flush();
  /// Returns the end of what is in the log, see RoomLog::Pin; its begin if there is none.
  LogPlace Pin() { return log_ != nullptr ? log_->Pin() : LogPlace(); }
  /// The thread for what waits for the disk.
  DiskThread& disk() { return disk_; }

 private:
  void Listen(const std::string& lcm_url, const std::string& room);
  bool Ready();
  void OpenLog();

  std::string record_path_;
  bool force_;
  std::shared_ptr<const Secret> log_key_;
  std::int64_t segment_bytes_;
  std::unique_ptr<Bus> bus_;
  DiskThread disk_;
  std::unique_ptr<RoomLog> log_;  ///< null until it begins
  Status not_opened_;
  std::int64_t lost_ = 0;  ///< messages lost because the log could not be created
  std::map<std::string, bool> own_channels_;
};

}  // namespace seam
