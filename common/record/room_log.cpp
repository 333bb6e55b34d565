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

namespace seam {
namespace {

/// Bytes of TickChain::log_crc, the last ones of an encoded TickChain and so of its event.
constexpr std::size_t kChainCrcBytes = 4;

}  // namespace

RoomLog::RoomLog(const std::string& path, bool force, DiskThread* disk)
    : path_(path), disk_(disk), file_(std::make_shared<File>(LogWriter::Open(path, force))) {}

RoomLog::RoomLog(const std::string& path, const LogPlace& place, DiskThread* disk)
    : path_(path), disk_(disk), place_(place) {
  std::FILE* const stream = OpenPlainFile(path, FileUse::kAppend);
  if (stream == nullptr) {
    throw OperatorError(path + ": cannot be written: " + std::strerror(errno));
  }
  file_ = std::make_shared<File>(stream);
  if (flock(fileno(stream), LOCK_EX | LOCK_NB) != 0) {
    throw OperatorError(path + ": another program goes on with it");
  }
  if (ftruncate(fileno(stream), static_cast<off_t>(place.bytes)) != 0) {
    throw OperatorError(path + ": cannot be written: " + std::strerror(errno));
  }
}

RoomLog::~RoomLog() { Flush(); }

void RoomLog::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
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
  if (room_.empty()) room_ = RoomOfChannel(channel);
  if (session_ == 0) session_ = SessionOf(message).value_or(0);
  last_utime_ = utime;
  AppendEvent(&buffer_, place_.number + events_, utime, channel, message);
  ++events_;
}

void RoomLog::EndTick(const std::string& channel, const TickChain& chain) {
  Seal(channel, chain);
  Write();
}

void RoomLog::Flush() {
  if (events_ > 0 && !room_.empty() && trouble_.ok()) {
    TickChain chain;
    chain.utime = last_utime_;
    chain.session = session_ == 0 ? 1 : session_;
    chain.sequence = own_chains_++;
    chain.tick = tick_;
    chain.messages = -1;
    Seal(ChannelName(room_, "chain"), chain);
  }
  Write();
}

void RoomLog::Seal(const std::string& channel, TickChain chain) {
  tick_ = chain.tick;
  chain.log_events = events_ + 1;
  Publish(channel, chain.utime, Encode(chain));
  if (!trouble_.ok()) return;
  std::uint8_t* const at = buffer_.data() + buffer_.size() - kChainCrcBytes;
  place_.crc = Crc32c({buffer_.data(), buffer_.size() - kChainCrcBytes}, place_.crc);
  for (std::size_t i = 0; i < kChainCrcBytes; ++i) {
    at[i] = static_cast<std::uint8_t>(place_.crc >> (8 * (kChainCrcBytes - 1 - i)));
  }
}

void RoomLog::Write() {
  if (const int error = file_->sync_error.exchange(0)) Fail(error);
  std::size_t written = 0;
  while (trouble_.ok() && written < buffer_.size()) {
    const ssize_t now =
        write(fileno(file_->stream), buffer_.data() + written, buffer_.size() - written);
    if (now > 0) written += static_cast<std::size_t>(now);
    if (now < 0 && errno != EINTR) Fail(errno);
    if (now == 0) Fail(ENOSPC);
  }
  if (trouble_.ok()) {
    place_.bytes += static_cast<std::int64_t>(buffer_.size());
    place_.number += events_;
    if (!buffer_.empty()) Sync();
  }
  buffer_.clear();
  events_ = 0;
}

/// Takes back a tick of which only a part could be written.
void RoomLog::Fail(int error) {
  failures_ += std::max(1, events_);
  if (!trouble_.ok()) return;
  trouble_ = Status::Error(path_ + ": cannot be written: " + std::strerror(error));
  if (ftruncate(fileno(file_->stream), static_cast<off_t>(place_.bytes)) != 0) ++failures_;
}

void RoomLog::Sync() {
  if (disk_ == nullptr) return;
  const std::int64_t now_us = SteadyClockUs();
  if (now_us - synced_us_ < kSyncUs || file_->syncing.exchange(true)) return;
  synced_us_ = now_us;
  disk_->Do([file = file_] {
    if (fdatasync(fileno(file->stream)) != 0) file->sync_error = errno;
    file->syncing = false;
  });
}

}  // namespace seam
