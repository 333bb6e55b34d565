#pragma once
/// What `--lcm-url` and `--record` mean: a peer's recorder made of a bus, a log file, both or none.

#include <map>
#include <memory>
#include <string>

#include "common/record/bus.h"
#include "common/record/log_file.h"

namespace seam {

/// Publishes to the bus (unless `lcm_url` is "none") and writes `record_path` (unless empty). With
/// both, the log also holds what other peers of the room publish on the bus, so that it is the log
/// that lcm-logger would have written. It begins with the first message that is published here: a
/// program that never gets so far leaves no file, and a file that may be overwritten as it was. A
/// file that cannot be made then is given up: a log without its beginning has no scene.
class Sink : public Recorder {
 public:
  /// Throws OperatorError from Bus, or for a file that cannot be written.
  Sink(const std::string& lcm_url, const std::string& record_path, bool force,
       const std::string& room);

  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  std::int64_t failures() const override;
  bool listening() const override { return bus_ != nullptr || !record_path_.empty(); }
  /// The first failure to write the log; ok without one, and without a log.
  const Status& trouble() const;
  /// Takes what other peers have published into the log. Call often; never blocks.
  void Poll();
  /// Hands the log to the operating system, so that failures() knows of a full disk.
  void Flush();

 private:
  void OpenLog();

  std::string record_path_;
  bool force_;
  std::unique_ptr<Bus> bus_;
  std::unique_ptr<LogWriter> log_;  ///< null until it begins
  Status not_opened_;
  std::int64_t lost_ = 0;  ///< messages for a log that could not be made
  std::map<std::string, bool> own_channels_;
};

}  // namespace seam
