#pragma once
/// LCM event logs without lcm::LogFile, which crashes on damaged files. The writer's bytes depend
/// only on its arguments; the reader recovers the undamaged part of a log.
///
///   event: magic 0xEDA1DA01 u32 | number i64 | timestamp_us i64 | channel_bytes i32
///          | data_bytes i32 | channel | data   (big-endian; the format of LCM 1.3's eventlog.c)

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/status.h"
#include "common/record/chain_check.h"
#include "common/record/log_place.h"
#include "common/record/recorder.h"
#include "common/record/segments/log_segments.h"

namespace seam {

/// The magic at the start of each event.
constexpr std::uint32_t kLogMagic = 0xEDA1DA01u;
constexpr std::size_t kLogHeaderBytes = 28;
/// Largest message in a log, normal 60 kB; a header with more counts as damage.
constexpr std::size_t kLogDataBytesMax = 1000000;

/// Writes logs like those of lcm-logger; lcm-logplayer reads the result. Rooms are recorded by
/// RoomLog, which adds checksums.
class LogWriter : public Recorder {
 public:
  /// Throws whatever the constructor would, but does not touch the file: for a log that begins
  /// later.
  static void Check(const std::string& path, bool force);
  /// Returns the file that the constructor would write; the caller closes it. Throws likewise.
  static std::FILE* Open(const std::string& path, bool force);
  /// Throws OperatorError when the file cannot be created, exists and `force` is not given, or is
  /// no regular file.
  explicit LogWriter(const std::string& path, bool force = false);
  ~LogWriter() override;
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  /// Appends an event with the timestamp `utime`. Counts a failure when the disk is full, the
  /// channel is empty or longer than kChannelBytesMax, or the message exceeds kLogDataBytesMax.
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  std::int64_t failures() const override { return failures_; }
  /// Returns the first failure: "PATH: cannot be written: No space left on device". Output is
  /// buffered for some kilobytes or until Flush; a failure shows only then.
  const Status& trouble() const { return trouble_; }
  /// Passes buffered bytes to the operating system; counts a failure.
  void Flush();

 private:
  void Fail(const std::string& why);

  std::string path_;
  Status trouble_;
  std::FILE* file_ = nullptr;
  std::int64_t number_ = 0;
  std::int64_t failures_ = 0;
};

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t timestamp_us = 0;
  std::string channel;
  Bytes data;

  friend bool operator==(const LogEvent& a, const LogEvent& b) {
    return a.number == b.number && a.timestamp_us == b.timestamp_us && a.channel == b.channel &&
           a.data == b.data;
  }
};

/// Reads event by event; after damage, searches for the next plausible header. An event with
/// damaged lengths may come out truncated or merged with the next: validate the data by decoding.
/// All segments of a log are read as one, without the keyframes between them.
class LogReader {
 public:
  /// Throws OperatorError when the file cannot be opened, is no regular file, or has no event at
  /// all ("not an LCM log"). Reads the present contents only, not bytes appended later.
  /// With `key`, damage() also has the parts that nobody with the key wrote. `path`: of a log, all
  /// its segments; a folder, those of the log in it; a later segment, it alone.
  explicit LogReader(const std::string& path, const Secret* key = nullptr);
  /// Reads from a place on that RoomLog gave. Throws also when the log is shorter than that.
  LogReader(const std::string& path, const LogPlace& from, const Secret* key = nullptr);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;
  /// Reads the next event; false at the end. Never throws because of the file's contents.
  bool Next(LogEvent* event);
  /// Returns the number of bytes outside all events returned by Next.
  std::int64_t skipped_bytes() const { return skipped_bytes_; }
  /// Returns the number of stretches of such bytes.
  std::int64_t damaged_places() const { return damaged_places_; }
  /// Returns the parts of the log with wrong checksums; complete when Next has returned false.
  std::vector<DamagedRange> damage() const { return check_.Damage(); }
  /// True if all before the last end of a tick is as RoomLog wrote it.
  bool intact() const { return check_.intact(); }
  /// Returns the place in the file behind the last event, and the file's segment.
  std::int64_t place_bytes() const { return at_; }
  std::int32_t segment() const { return segments_[segment_].number; }
  /// Returns the tick before a log of which the first segments are not there.
  std::optional<std::int64_t> begins_after() const { return check_.begins_after(); }

 private:
  struct Header;
  void Open(std::size_t segment);
  bool NextInSegment(LogEvent* event);
  std::size_t ReadAt(std::int64_t at, std::uint8_t* to, std::size_t bytes);
  const std::uint8_t* Peek(std::int64_t at, std::size_t bytes);
  bool ReadHeader(std::int64_t at, bool magic_matters, Header* header);
  std::int64_t FindHeader(std::int64_t from, std::int64_t to);
  bool FollowedByEvent(std::int64_t end);
  bool ContainsNextEvent(std::int64_t at, const Header& header);

  std::vector<LogSegment> segments_;
  std::size_t segment_ = 0;  ///< index of the open one
  int keyframe_seals_ = 0;   ///< left until its keyframe is over
  std::FILE* file_ = nullptr;
  Bytes window_;  ///< a stretch of the file, from window_at_
  std::int64_t window_at_ = 0;
  std::uint8_t peeked_header_[kChannelBytesMax] = {};
  std::int64_t at_ = 0;  ///< expected start of the next event
  std::int64_t size_bytes_ = 0;
  std::int64_t skipped_bytes_ = 0;
  std::int64_t damaged_places_ = 0;
  ChainCheck check_;
};

}  // namespace seam
