#include "common/record/sink.h"

#include <algorithm>
#include <cctype>

namespace seam {
namespace {

/// Bus messages taken per Poll, so that a flood cannot hold up the simulation.
constexpr int kPollsMost = 64;

}  // namespace

Sink::Sink(const std::string& lcm_url, const std::string& record_path, bool force,
           const std::string& room) {
  if (lcm_url != "none") bus_ = std::make_unique<Bus>(lcm_url);
  if (record_path.empty()) return;
  log_ = std::make_unique<LogWriter>(record_path, force);
  if (bus_ == nullptr) return;
  bus_->Subscribe("SEAM\\." + room + "\\..*",
                  [this](const std::string& channel, std::int64_t utime, ByteView message) {
                    // Our own messages come back by loopback; they are in the log already.
                    if (own_channels_.count(channel) == 0) log_->Publish(channel, utime, message);
                  });
}

void Sink::Publish(const std::string& channel, std::int64_t utime, ByteView message) {
  if (log_ != nullptr) {
    own_channels_[channel] = true;
    log_->Publish(channel, utime, message);
  }
  if (bus_ != nullptr) bus_->Publish(channel, utime, message);
}

std::int64_t Sink::failures() const {
  return (bus_ != nullptr ? bus_->failures() : 0) + (log_ != nullptr ? log_->failures() : 0);
}

void Sink::Poll() {
  if (log_ != nullptr && bus_ != nullptr) {
    for (int n = 0; n < kPollsMost; ++n) bus_->Poll(0);
  }
}

}  // namespace seam
