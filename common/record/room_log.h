#pragma once
/// The log of a room that a program writes itself: a LogWriter's format, with the checksum of each
/// tick's bytes in a TickChain, so that LogReader finds any damage.
///
///   tick n:    events ... | TickChain      one write(2), before the tick's datagrams leave
///   each 50 ms:  fdatasync, in a DiskThread
///
/// A process that is killed loses the tick that it has not written; a machine that loses power the
/// last 50 ms and what the disk delays.

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "common/base/bytes.h"
#include "common/base/status.h"
#include "common/record/log_place.h"
#include "common/record/recorder.h"

namespace seam {

class DiskThread;

class RoomLog : public Recorder {
 public:
  /// Begins a log. `disk` syncs it, and must outlive this; nullptr: nothing does. Throws
  /// OperatorError as LogWriter does.
  RoomLog(const std::string& path, bool force, DiskThread* disk);
  /// Goes on with a log at `place`; cuts off the bytes behind it. Throws OperatorError if it cannot
  /// be written, or another program has it open by this constructor.
  RoomLog(const std::string& path, const LogPlace& place, DiskThread* disk);
  /// Flushes.
  ~RoomLog() override;
  RoomLog(const RoomLog&) = delete;
  RoomLog& operator=(const RoomLog&) = delete;

  /// Adds an event with the timestamp `utime`; it is written with the end of the tick.
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  /// Writes all events since the last call, and `chain` with the checksum of their bytes. If they
  /// cannot be written the file ends where it did before, and nothing is written any more.
  void EndTick(const std::string& channel, const TickChain& chain) override;
  /// Writes the events since the last tick, with a TickChain of its own.
  void Flush();
  /// Number of events that were not written.
  std::int64_t failures() const override { return failures_; }
  /// Returns the first failure: "PATH: cannot be written: No space left on device".
  const Status& trouble() const { return trouble_; }
  /// Returns the end of the written bytes.
  const LogPlace& place() const { return place_; }

  /// Time between two syncs, us.
  static constexpr std::int64_t kSyncUs = 50000;

 private:
  /// The open file, which a sync may use longer than this object lives.
  struct File {
    explicit File(std::FILE* open) : stream(open) {}
    ~File() { std::fclose(stream); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    std::FILE* stream;
    std::atomic<bool> syncing{false};
    std::atomic<int> sync_error{0};
  };
  void Seal(const std::string& channel, TickChain chain);
  void Write();
  void Sync();
  void Fail(int error);

  const std::string path_;
  DiskThread* const disk_;
  std::shared_ptr<File> file_;
  Status trouble_;
  LogPlace place_;
  Bytes buffer_;             // events since place_
  std::int32_t events_ = 0;  // in buffer_
  std::string room_;         // of the channels; "": none so far
  std::int64_t session_ = 0;
  std::int64_t tick_ = 0;  // of the last TickChain
  std::int64_t own_chains_ = 0;
  std::int64_t last_utime_ = 0;
  std::int64_t synced_us_ = 0;
  std::int64_t failures_ = 0;
};

}  // namespace seam
