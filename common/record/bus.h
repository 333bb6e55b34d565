#pragma once
/// The LCM bus, safely: the only file pair that includes <lcm/lcm-cpp.hpp>.

#include <functional>
#include <memory>
#include <string>

#include "common/record/recorder.h"

namespace seam {

/// Publishes to and hears from LCM.
class Bus : public Recorder {
 public:
  /// `url`: as LCM's; "" takes LCM_DEFAULT_URL or LCM's default. Throws OperatorError when
  /// multicast cannot work, saying what to type (the `ip route add 224.0.0.0/4 ...` line).
  explicit Bus(const std::string& url);
  ~Bus() override;
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override;
  std::int64_t failures() const override;

  using Handler = std::function<void(const std::string& channel, std::int64_t utime, ByteView)>;
  /// Calls `handler` from Poll for each message whose channel matches the (anchored) regular
  /// expression. Exceptions of the handler are caught and counted. Sets a receive queue large
  /// enough for a burst.
  void Subscribe(const std::string& channel_regex, Handler handler);
  /// Handles what has arrived; waits at most `timeout_us` for the first message.
  void Poll(std::int64_t timeout_us);
  int fd() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
