#pragma once
/// The LCM bus, safely: its .cpp is the only file that includes <lcm/lcm-cpp.hpp>.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/record/recorder.h"

namespace seam {

/// Socket buffer that Bus asks for: with the default one, bursts of large messages are lost.
constexpr int kBusReceiveBytes = 4194304;

/// Publishes to and hears from LCM. For one thread.
class Bus : public Recorder {
 public:
  /// `url`: as LCM's; "" takes LCM_DEFAULT_URL or LCM's default; recv_buf_size is added when the
  /// url does not say it. Throws OperatorError when multicast cannot work, saying what to type
  /// (the `ip route add 224.0.0.0/4 ...` line). What LCM writes to stderr becomes that one line.
  explicit Bus(const std::string& url);
  ~Bus() override;
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// LCM has no time on the wire: `utime` is not sent. Refuses, and counts, messages above
  /// kBusMessageBytesMax, channels above kChannelBytesMax, and what the socket does not take.
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  /// Messages that could not be published, and handlers that threw.
  std::int64_t failures() const override;

  /// `utime`: when the message was received, us since 1970.
  using Handler = std::function<void(const std::string& channel, std::int64_t utime, ByteView)>;
  /// Calls `handler` from Poll for each message whose channel matches the regular expression
  /// (POSIX extended) as a whole. Exceptions of the handler are caught and counted. Sets a receive
  /// queue large enough for a burst. Throws OperatorError for a wrong expression, and when a
  /// firewall keeps multicast from coming back, which LCM notices after 10 s.
  void Subscribe(const std::string& channel_regex, Handler handler);
  /// Handles what has arrived; waits at most `timeout_us` for the first message. Returns at once
  /// when nothing is subscribed.
  void Poll(std::int64_t timeout_us);
  /// For poll(2): readable when Poll has something to do. -1 while nothing is subscribed.
  int fd() const;
  /// Lines worth showing to the operator: what is not as it should be, and what to type.
  const std::vector<std::string>& warnings() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
