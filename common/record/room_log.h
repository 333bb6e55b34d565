#pragma once
/// The log of a room that a program writes itself: a LogWriter's format, with a checksum of the
/// bytes in each LogSeal, so that LogReader finds any damage.
///
///   tick n:    events ... | LogSeal      one write(2), before the tick's datagrams leave
///   tick n+1:    events ... | LogSeal    in the place of that seal, unless it was kept
///   each 40 ms:  that seal is kept, and fdatasync, in a DiskThread
///
/// So the log always ends with a seal, and holds few of them; nothing that is on the disk is
/// written over. A process that is killed loses the tick that it has not written; a machine that
/// loses power the last three ticks at 60 Hz, more if the disk is slow. With a key each seal also
/// has a keyed hash, so that nobody else can change the log.
///
/// A log of more than `segment_bytes` goes on in another file, the next segment. That begins with a
/// Keyframe between two seals, of which the first goes on from the last seal of the segment before.

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/status.h"
#include "common/record/keyed_chain.h"
#include "common/record/log_place.h"
#include "common/record/recorder.h"
#include "common/record/segments/keyframe.h"

namespace seam {

class DiskThread;

/// Throws OperatorError if a process writes this file of a log now.
void RequireUnused(const std::string& path);

class RoomLog : public Recorder {
 public:
  /// Begins a log. `disk` syncs it, and must outlive this; nullptr: nothing does. `key`:
  /// nullptr: none. `segment_bytes`: 0: all in one file. Throws OperatorError as LogWriter does.
  RoomLog(const std::string& path, bool force, DiskThread* disk, const Secret* key = nullptr,
          std::int64_t segment_bytes = 0);
  /// Goes on with a log at `place`; cuts off the bytes behind it, and removes later segments. At
  /// the begin of a later segment, which must not be there, begins that. Throws OperatorError if it
  /// cannot be written, or another program has it open by this constructor.
  RoomLog(const std::string& path, const LogPlace& place, DiskThread* disk,
          const Secret* key = nullptr, std::int64_t segment_bytes = 0);
  /// Flushes.
  ~RoomLog() override;
  RoomLog(const RoomLog&) = delete;
  RoomLog& operator=(const RoomLog&) = delete;

  /// Adds an event with the timestamp `utime`; it is written with the end of the tick.
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  /// Writes all events since the last call, and `seal` with the checksum of their bytes. If they
  /// cannot be written the file ends where it did before, and nothing is written any more.
  void EndTick(const std::string& channel, const LogSeal& seal, bool kept) override;
  /// Writes the events since the last tick, with a LogSeal of its own; keeps the last seal of each
  /// channel.
  void Flush();
  /// Number of events that were not written.
  std::int64_t failures() const override { return failures_; }
  /// Returns the first failure: "PATH: cannot be written: No space left on device".
  const Status& trouble() const { return trouble_; }
  /// Returns the end of the written bytes, and keeps the seal there: a log may go on from it. The
  /// disk thread syncs it before its next job.
  LogPlace Pin();

  /// Time between two syncs, us; they begin with a tick, and wait for an event. More is lost with
  /// the power, less has more seals in the log, 0.1 kB each. The second where there are readings
  /// alone: views, statistics.
  static constexpr std::int64_t kSyncUs = 40000, kSyncReadingsUs = 1000000;

 private:
  /// A sync may use these longer than this object lives.
  using File = std::shared_ptr<std::FILE>;
  struct Syncs {
    std::atomic<bool> syncing{false};
    std::atomic<int> error{0};
  };
  void BeginSegmentIfDue(std::int64_t utime);
  Status OpenSegment();
  void WriteOwnSeal();
  void Write(const std::string& channel, LogSeal seal, bool kept);
  void AddKeyed(std::size_t seal_at);
  int WriteAt(std::int64_t at, const Bytes& bytes);
  int CutOff(std::int64_t bytes);
  void KeepSeal();
  void Sync(bool at_once);
  void Fail(int error);

  const std::string path_;
  DiskThread* const disk_;
  const std::int64_t segment_bytes_;
  File file_;
  const std::shared_ptr<Syncs> syncs_ = std::make_shared<Syncs>();
  Keyframe keyframe_;     // of the next segment
  bool unbegun_ = false;  // file_ is a later segment, and empty
  Status trouble_;
  LogPlace end_;               // of the written events, without a seal that is not kept
  std::int32_t unsealed_ = 0;  // events since the last kept seal; end_.crc includes them
  std::optional<Secret> key_;
  std::optional<KeyedChain> keyed_;  // of the log up to end_
  KeyedChain::Hash seal_keyed_{};    // of seal_
  Bytes seal_;                 // behind end_, not kept
  std::uint32_t seal_crc_ = 0;
  std::map<std::string, LogSeal> open_;  // the last seal of each channel that is not kept
  Bytes buffer_;                         // events to be written at end_
  std::vector<std::size_t> starts_;      // of each in buffer_
  std::string room_;                     // of the channels; "": none so far
  std::int64_t session_ = 0;
  std::int64_t tick_ = 0;  // of the last seal
  std::int32_t own_seals_ = 0;
  std::int64_t last_utime_ = 0;
  std::int64_t synced_us_ = 0;
  bool unsynced_ = false, urgent_ = false;  // events were written since then; not readings alone
  std::int64_t failures_ = 0;
};

}  // namespace seam
