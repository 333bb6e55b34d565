#pragma once
/// LCM event logs without lcm::LogFile, which crashes on damaged files: a writer whose bytes depend
/// on its arguments alone, and a reader that reads a damaged log as far as it is good.
///
///   event: magic 0xEDA1DA01 u32 | number i64 | timestamp_us i64 | channel_bytes i32 | data_bytes i32
///          | channel | data            (big-endian; the format of LCM 1.3's eventlog.c)

#include <cstdint>
#include <cstdio>
#include <string>

#include "common/base/bytes.h"
#include "common/record/recorder.h"

namespace seam {

/// Writes the format that lcm-logger writes and lcm-logplayer reads.
class LogWriter : public Recorder {
 public:
  /// Throws OperatorError when the file cannot be created. Refuses to overwrite unless `force`.
  explicit LogWriter(const std::string& path, bool force = false);
  ~LogWriter() override;
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  std::int64_t failures() const override { return failures_; }
  void Flush();

 private:
  std::FILE* file_ = nullptr;
  std::int64_t number_ = 0;
  std::int64_t failures_ = 0;
};

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t timestamp_us = 0;
  std::string channel;
  Bytes data;
};

/// Reads event by event. After damage it searches for the next plausible header.
class LogReader {
 public:
  /// Throws OperatorError when the file cannot be opened or has no event at all ("not an LCM log").
  explicit LogReader(const std::string& path);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;
  /// False at the end.
  bool Next(LogEvent* event);
  std::int64_t skipped_bytes() const { return skipped_bytes_; }
  std::int64_t damaged_places() const { return damaged_places_; }

 private:
  std::FILE* file_ = nullptr;
  std::int64_t size_bytes_ = 0;
  std::int64_t skipped_bytes_ = 0;
  std::int64_t damaged_places_ = 0;
};

}  // namespace seam
