#include "common/record/sink.h"

#include <utility>

#include "common/base/check.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// Calls of Bus::Poll per Poll, so that a flood cannot hold up the simulation.
constexpr int kPollsMax = 64;

}  // namespace

Sink::Sink(const std::string& lcm_url, const std::string& record_path, bool force,
           const std::string& room, std::shared_ptr<const Secret> log_key,
           std::int64_t segment_bytes)
    : record_path_(record_path),
      force_(force),
      log_key_(std::move(log_key)),
      segment_bytes_(segment_bytes) {
  if (!record_path.empty()) LogWriter::Check(record_path, force);
  Listen(lcm_url, room);
}

Sink::Sink(const std::string& lcm_url, const std::string& record_path, const LogPlace& place,
           const std::string& room, std::shared_ptr<const Secret> log_key,
           std::int64_t segment_bytes)
    : record_path_(record_path),
      force_(false),
      log_key_(std::move(log_key)),
      segment_bytes_(segment_bytes),
      log_(std::make_unique<RoomLog>(record_path, place, &disk_, log_key_.get(), segment_bytes)) {
  Listen(lcm_url, room);
}

void Sink::Listen(const std::string& lcm_url, const std::string& room) {
  if (lcm_url != "none") bus_ = std::make_unique<Bus>(lcm_url);
  if (record_path_.empty() || bus_ == nullptr) return;
  bus_->Subscribe("SEAM\\." + room + "\\..*",
                  [this](const std::string& channel, std::int64_t utime, ByteView message) {
                    // Our own messages come back by loopback; they are in the log already.
                    if (log_ == nullptr || own_channels_.count(channel) != 0) return;
                    log_->Publish(channel, utime, message);
                  });
}

void Sink::OpenLog() {
  try {
    log_ = std::make_unique<RoomLog>(record_path_, force_, &disk_, log_key_.get(), segment_bytes_);
  } catch (const OperatorError& error) {
    // Possible despite the check at the start: the file or folder may have changed since.
    not_opened_ = Status::Error(error.what());
  }
}

/// Returns true if there is a log; begins it if it is wanted.
bool Sink::Ready() {
  if (log_ == nullptr && !record_path_.empty()) {
    if (not_opened_.ok()) OpenLog();
    if (!not_opened_.ok()) ++lost_;
  }
  return log_ != nullptr;
}

void Sink::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (Ready()) {
    own_channels_[channel] = true;
    log_->Publish(channel, utime, message);
  }
  if (bus_ != nullptr) bus_->Publish(channel, utime, message);
}

void Sink::EndTick(const std::string& channel, const LogSeal& seal, bool kept) {
  if (Ready()) {
    own_channels_[channel] = true;
    log_->EndTick(channel, seal, kept);
  }
  if (bus_ != nullptr) bus_->EndTick(channel, seal, kept);
}

std::int64_t Sink::failures() const {
  return (bus_ != nullptr ? bus_->failures() : 0) + (log_ != nullptr ? log_->failures() : 0) +
         lost_;
}

const Status& Sink::trouble() const { return log_ != nullptr ? log_->trouble() : not_opened_; }

void Sink::Flush() {
  if (log_ != nullptr) log_->Flush();
}

void Sink::Poll() {
  if (bus_ == nullptr || bus_->fd() < 0) return;
  for (int n = 0; n < kPollsMax; ++n) bus_->Poll(0);
}

}  // namespace seam
