#include "common/record/room_log.h"

#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/codec/codec.h"
#include "common/net/crc32c.h"
#include "common/record/disk_thread.h"
#include "common/record/log_bytes.h"
#include "common/record/log_file.h"
#include "common/record/segments/log_segments.h"

namespace seam {

static_assert(kLogKeyedBytes == std::tuple_size<KeyedChain::Hash>::value);

namespace {

/// Throws OperatorError if another process writes the log.
void LockLog(const std::string& path, std::FILE* stream) {
  if (flock(fileno(stream), LOCK_EX | LOCK_NB) != 0)
    throw OperatorError(path + ": another program goes on with it");
}

/// Opens a new log, or one in place of a log that nobody writes.
std::FILE* OpenUnused(const std::string& path, bool force) {
  const std::vector<LogSegment> there = ListSegments(path);
  for (const LogSegment& segment : there) {
    if (force) RequireUnused(segment.path);
  }
  for (const LogSegment& segment : there) {
    if (segment.number == 0) continue;
    if (!force) throw OperatorError(segment.path + ": exists (--force replaces it)");
    std::remove(segment.path.c_str());
  }
  return LogWriter::Open(path, force);
}

Status NotWritten(const std::string& path, int error) {
  return Status::Error(path + ": cannot be written: " + std::strerror(error));
}

/// True for readings, of which nothing of a room is made again.
bool IsReading(const std::string& channel) {
  static const std::string kinds[] = {MessageTraits<View>::kKind, MessageTraits<Strands>::kKind,
                                      MessageTraits<Impacts>::kKind, MessageTraits<Stats>::kKind,
                                      MessageTraits<Load>::kKind};
  return std::any_of(std::begin(kinds), std::end(kinds), [&](const std::string& kind) {
    const std::size_t at = channel.find("." + kind);
    return at != std::string::npos &&
           (at + kind.size() + 1 == channel.size() || channel[at + kind.size() + 1] == '.');
  });
}

[[noreturn]] void ThrowNotWritten(const std::string& path) {
  throw OperatorError(NotWritten(path, errno).why());
}

}  // namespace

void RequireUnused(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> log(OpenPlainFile(path, FileUse::kRead),
                                                            &std::fclose);
  if (log != nullptr) LockLog(path, log.get());
}

RoomLog::RoomLog(const std::string& path, bool force, DiskThread* disk, const Secret* key,
                 std::int64_t segment_bytes)
    : path_(path),
      disk_(disk),
      segment_bytes_(segment_bytes),
      file_(OpenUnused(path, force), &std::fclose) {
  LockLog(path, file_.get());
  if (key != nullptr) key_ = *key, keyed_.emplace(*key);
}

RoomLog::RoomLog(const std::string& path, const LogPlace& place, DiskThread* disk,
                 const Secret* key, std::int64_t segment_bytes)
    : path_(path), disk_(disk), segment_bytes_(segment_bytes), end_(place), tick_(place.tick) {
  if (key != nullptr) key_ = *key, keyed_.emplace(*key, place.keyed);
  unbegun_ = place.segment > 0 && place.bytes == 0;
  const std::string open = SegmentPath(path, place.segment);
  std::FILE* const stream =
      unbegun_ ? LogWriter::Open(open, false) : OpenPlainFile(open, FileUse::kGoOn);
  if (stream == nullptr) ThrowNotWritten(open);
  file_.reset(stream, &std::fclose);
  LockLog(open, stream);
  const std::vector<LogSegment> later = ListSegments(path, place.segment + 1);
  for (const LogSegment& segment : later) RequireUnused(segment.path);
  for (auto segment = later.rbegin(); segment != later.rend(); ++segment) {
    if (std::remove(segment->path.c_str()) != 0) ThrowNotWritten(segment->path);
  }
  if (ftruncate(fileno(stream), static_cast<off_t>(place.bytes)) != 0) ThrowNotWritten(open);
}

RoomLog::~RoomLog() { Flush(); }

void RoomLog::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (room_.empty()) room_ = RoomOfChannel(channel);
  if (session_ == 0) session_ = SessionOf(message).value_or(0);
  if (starts_.empty()) BeginSegmentIfDue(utime);
  if (!trouble_.ok()) {
    ++failures_;
    return;
  }
  if (!FitsLog(channel, message)) {
    ++failures_;
    trouble_ = Status::Error(path_ + ": cannot be written: a message of " +
                             std::to_string(message.size) + " bytes does not fit a log");
    return;
  }
  last_utime_ = utime;
  if (segment_bytes_ > 0) keyframe_.Note(channel, message);
  urgent_ = urgent_ || !IsReading(channel);
  starts_.push_back(buffer_.size());
  AppendEvent(&buffer_, 0, utime, channel, message);
}

void RoomLog::EndTick(const std::string& channel, const LogSeal& seal, bool kept) {
  if (kept) {
    open_.erase(channel);
  } else {
    open_[channel] = seal;
  }
  if (room_.empty()) room_ = RoomOfChannel(channel);
  if (starts_.empty()) BeginSegmentIfDue(seal.utime);
  Write(channel, seal, kept);
}

void RoomLog::Flush() {
  KeepSeal();
  if (!starts_.empty() && !room_.empty()) WriteOwnSeal();
  // The last of them stands there already.
  for (auto it = open_.begin(); open_.size() > 1 && it != open_.end(); ++it) {
    it->second.utime = last_utime_;  // a log's times do not run backwards
    Write(it->first, it->second, true);
  }
  open_.clear();
}

/// Writes the events with a seal that says nothing of a publisher's messages.
void RoomLog::WriteOwnSeal() {
  LogSeal seal;
  seal.utime = last_utime_;
  seal.session = session_ == 0 ? 1 : session_;
  seal.sequence = own_seals_++;
  seal.tick = tick_;
  seal.messages = -1;
  Write(ChannelName(room_, MessageTraits<LogSeal>::kKind), seal, true);
}

/// Begins the next segment if this one is full, between two ticks. If that cannot be written, this
/// one stays the log's last.
void RoomLog::BeginSegmentIfDue(std::int64_t utime) {
  const bool full = segment_bytes_ > 0 && end_.bytes >= segment_bytes_;
  if ((!full && !unbegun_) || room_.empty() || !trouble_.ok()) return;
  const LogPlace end = Pin();
  const File file = file_;
  if (!unbegun_) trouble_ = OpenSegment();
  if (!trouble_.ok()) return;
  unbegun_ = false;
  last_utime_ = utime;
  WriteOwnSeal();
  keyframe_.Each([this, utime](const std::string& channel, ByteView message) {
    starts_.push_back(buffer_.size());
    AppendEvent(&buffer_, 0, utime, channel, message);
  });
  WriteOwnSeal();
  if (trouble_.ok()) return;
  std::remove(SegmentPath(path_, end_.segment).c_str());
  end_ = end;
  file_ = file;
}

/// Creates the next segment. Returns one line if it cannot.
Status RoomLog::OpenSegment() {
  const std::string path = SegmentPath(path_, end_.segment + 1);
  const File file(OpenPlainFile(path, FileUse::kCreate), [](std::FILE* open) {
    if (open != nullptr) std::fclose(open);
  });
  if (file == nullptr || flock(fileno(file.get()), LOCK_EX | LOCK_NB) != 0) {
    return NotWritten(path, errno);
  }
  file_ = file;
  end_.segment += 1;
  end_.bytes = 0;
  if (disk_ != nullptr) disk_->Do([path] { SyncFolderOf(path); });
  return Status::Ok();
}

LogPlace RoomLog::Pin() {
  KeepSeal();
  Sync(true);
  return end_;
}

void RoomLog::KeepSeal() {
  if (seal_.empty()) return;
  end_.bytes += static_cast<std::int64_t>(seal_.size());
  end_.number += 1;
  end_.crc = seal_crc_;
  end_.tick = tick_;
  end_.keyed = seal_keyed_;
  if (keyed_) keyed_.emplace(*key_, seal_keyed_);
  unsealed_ = 0;
  seal_.clear();
}

/// Writes the events and the seal, in the place of the last seal unless that was kept.
void RoomLog::Write(const std::string& channel, LogSeal seal, bool kept) {
  if (const int error = syncs_->error.exchange(0)) Fail(error);
  if (!trouble_.ok()) {
    ++failures_;
    return;
  }
  tick_ = seal.tick;
  unsynced_ = unsynced_ || !starts_.empty();
  const auto events = static_cast<std::int32_t>(starts_.size());
  for (std::int32_t i = 0; i < events; ++i) {
    SetEventNumber(&buffer_, starts_[static_cast<std::size_t>(i)], end_.number + i);
  }
  const std::uint32_t crc = Crc32c(buffer_, end_.crc);
  const std::size_t seal_at = buffer_.size();
  seal.log_events = unsealed_ + events + 1;
  if (keyed_) seal.log_keyed.resize(kLogKeyedBytes);
  AppendEvent(&buffer_, end_.number + events, seal.utime, channel, Encode(seal));
  if (keyed_) AddKeyed(seal_at);
  const std::size_t crc_at = buffer_.size() - kSealCrcBytes;
  const std::uint32_t seal_crc = Crc32c({buffer_.data() + seal_at, crc_at - seal_at}, crc);
  for (std::size_t i = 0; i < kSealCrcBytes; ++i) {
    buffer_[crc_at + i] = static_cast<std::uint8_t>(seal_crc >> (8 * (kSealCrcBytes - 1 - i)));
  }
  int error = WriteAt(end_.bytes, buffer_);
  if (error == 0 && seal_.size() > buffer_.size()) {  // the last one reached farther
    error = CutOff(end_.bytes + static_cast<std::int64_t>(buffer_.size()));
  }
  if (error != 0) return Fail(error);
  end_.bytes += static_cast<std::int64_t>(seal_at);
  end_.number += events;
  end_.crc = crc;
  unsealed_ += events;
  seal_.assign(buffer_.begin() + static_cast<std::ptrdiff_t>(seal_at), buffer_.end());
  seal_crc_ = seal_crc;
  buffer_.clear();
  starts_.clear();
  if (kept) KeepSeal();
  Sync(false);
}

/// Fills in the keyed hash of the events and the seal in buffer_.
void RoomLog::AddKeyed(std::size_t seal_at) {
  const std::size_t keyed_at = buffer_.size() - kSealKeyedBytes;
  keyed_->Add({buffer_.data(), seal_at});
  KeyedChain with_seal = *keyed_;
  with_seal.Add({buffer_.data() + seal_at, keyed_at - seal_at});
  seal_keyed_ = with_seal.Now();
  std::copy(seal_keyed_.begin(), seal_keyed_.end(),
            buffer_.begin() + static_cast<std::ptrdiff_t>(keyed_at));
}

/// Returns 0, or the error.
int RoomLog::WriteAt(std::int64_t at, const Bytes& bytes) {
  for (std::size_t written = 0; written < bytes.size();) {
    const ssize_t now = pwrite(fileno(file_.get()), bytes.data() + written, bytes.size() - written,
                               at + static_cast<std::int64_t>(written));
    if (now == 0) return ENOSPC;
    if (now > 0) written += static_cast<std::size_t>(now);
    if (now < 0 && errno != EINTR) return errno;
  }
  return 0;
}

int RoomLog::CutOff(std::int64_t bytes) {
  return ftruncate(fileno(file_.get()), static_cast<off_t>(bytes)) == 0 ? 0 : errno;
}

/// Takes back a tick of which only a part could be written.
void RoomLog::Fail(int error) {
  failures_ += static_cast<std::int64_t>(starts_.size()) + 1;
  buffer_.clear();
  starts_.clear();
  if (!trouble_.ok()) return;
  trouble_ = NotWritten(SegmentPath(path_, end_.segment), error);
  if (CutOff(end_.bytes) != 0 || WriteAt(end_.bytes, seal_) != 0) ++failures_;
}

/// Nothing that is synced is written over: what the disk has of that is not known without power.
void RoomLog::Sync(bool at_once) {
  if (disk_ == nullptr) return;
  const std::int64_t now_us = SteadyClockUs();
  const std::int64_t after_us = urgent_ ? kSyncUs : kSyncReadingsUs;
  const bool due = unsynced_ && now_us - synced_us_ >= after_us && !syncs_->syncing.exchange(true);
  if (!due && !at_once) return;
  synced_us_ = now_us;
  unsynced_ = urgent_ = false;
  KeepSeal();
  disk_->Do([file = file_, syncs = syncs_] {
    if (fdatasync(fileno(file.get())) != 0) syncs->error = errno;
    syncs->syncing = false;
  });
}

}  // namespace seam
