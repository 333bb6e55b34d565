#pragma once
/// The way from a page's server to the control door of a seam-server on this machine.

#include <cstdint>
#include <string>

#include "common/base/status.h"

namespace seam {

class ControlLine {
 public:
  /// `url`: as seam-server --control prints it, "http://127.0.0.1:9465/control?token=...". Throws
  /// OperatorError if it is none.
  explicit ControlLine(const std::string& url);

  /// Sends a command ("": asks for the present values alone) and waits for the answer, for at most
  /// kAnswerUs; a door that has not answered is not asked again for kAgainUs. Returns the door's
  /// one line if it refuses.
  Status Send(std::int64_t now_us, const std::string& command);
  /// Asks for the present values each second.
  void Tick(std::int64_t now_us);
  /// Returns the present values as JSON, as of the last answer; "" while the door does not answer.
  const std::string& state() const { return state_; }

  /// The door answers within a tick of its room; longer holds up the watchers.
  static constexpr std::int64_t kAnswerUs = 200000;
  static constexpr std::int64_t kAgainUs = 2000000;

 private:
  std::string address_, target_, state_;
  std::int64_t asked_us_ = -kAgainUs, silent_us_ = -kAgainUs;
};

}  // namespace seam
