#pragma once
/// The door through which an operator changes a running room: commands over HTTP on this machine,
/// with the token that the server printed.

#include <cstdint>
#include <functional>
#include <string>

#include "common/base/status.h"
#include "common/net/http_server.h"

namespace seam {

class ControlDoor {
 public:
  using Do = std::function<Status(const std::string& command)>;
  using State = std::function<std::string()>;
  /// `act`: does a command. `state`: returns the present values as JSON.
  ControlDoor(std::string token, Do act, State state);

  /// Answers POST /control?token=... with a command as the body, and GET for the present values,
  /// which are the answer to a command that was done as well. Anything else is refused by one line.
  HttpResponse Answer(std::int64_t now_us, const HttpRequest& request);

  /// Commands a second, and at once: more than eight hands send.
  static constexpr double kCommandsPerS = 200, kCommandsAtOnce = 200;

 private:
  const std::string token_;
  const Do act_;
  const State state_;
  double credit_ = kCommandsAtOnce;
  std::int64_t credited_us_ = 0;
};

}  // namespace seam
