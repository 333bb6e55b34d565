#pragma once
/// A safe wrapper of the LCM bus. Its .cpp is the only file that includes <lcm/lcm-cpp.hpp>.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/record/recorder.h"

namespace seam {

/// Socket buffer that Bus requests, bytes: the default one loses bursts of large messages.
constexpr int kBusReceiveBytes = 4194304;

/// Publishes and receives LCM messages. For one thread.
class Bus : public Recorder {
 public:
  /// `url` is LCM's; "" means LCM_DEFAULT_URL or LCM's default. Adds recv_buf_size if the url has
  /// none. Throws OperatorError when multicast cannot work, with the command that fixes it (`ip
  /// route add 224.0.0.0/4 ...`). LCM's own lines on stderr are condensed into that one line.
  explicit Bus(const std::string& url);
  ~Bus() override;
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Publishes a message. Drops and counts messages above kBusMessageBytesMax, channels above
  /// kChannelBytesMax, and failed sends. `utime` is not sent: LCM has no time on the wire.
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  void Repeat(const std::string& channel, std::int64_t utime, ByteView message) override {
    Publish(channel, utime, message);
  }
  /// Returns the number of unpublished messages plus handler calls that threw.
  std::int64_t failures() const override;

  /// `utime`: time of receipt, us since 1970.
  using Handler = std::function<void(const std::string& channel, std::int64_t utime, ByteView)>;
  /// Makes Poll call `handler` for each message on a channel that matches the whole regular
  /// expression (POSIX extended). Exceptions of the handler are caught and counted. Makes the
  /// receive queue large enough for a burst. Throws OperatorError for an invalid expression, and,
  /// after LCM's 10 s, when a firewall blocks multicast loopback.
  void Subscribe(const std::string& channel_regex, Handler handler);
  /// Handles arrived messages; waits at most `timeout_us` for the first one. Returns at once if
  /// nothing is subscribed.
  void Poll(std::int64_t timeout_us);
  /// Returns the descriptor for poll(2), readable when Poll has work; -1 without subscriptions.
  int fd() const;
  /// Returns warnings for the operator, each with a remedy.
  const std::vector<std::string>& warnings() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
