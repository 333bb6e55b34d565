#include "client/input_lines.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/sync/inputs/input_line.h"

namespace seam {
InputLines::InputLines(const std::string& path) : path_(path) {
  fd_ = path == "-" ? fcntl(0, F_DUPFD_CLOEXEC, 3)
                    : open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) throw OperatorError("--inputs " + path + ": " + std::strerror(errno));
  (void)fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL) | O_NONBLOCK);
}

InputLines::~InputLines() { close(fd_); }

Input InputLines::Poll() {
  Input now = held_;
  char bytes[512];
  for (ssize_t got = 0; !ended_ && (got = read(fd_, bytes, sizeof bytes)) >= 0;) {
    if (got == 0) {
      ended_ = true;
      held_ = Input();
      break;
    }
    pending_.append(bytes, static_cast<std::size_t>(got));
    for (std::size_t end = 0; (end = pending_.find('\n')) != std::string::npos;) {
      const std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      if (!ParseInputLine(line, &held_)) {
        throw OperatorError("--inputs: \"" + line.substr(0, kInputLineBytesMax) +
                            "\" must be DRIVE LIFT BUTTONS: -127 to 127 twice, 0 to 1023");
      }
      now.buttons = static_cast<std::int16_t>(now.buttons | held_.buttons);
    }
    if (pending_.size() > kInputLineBytesMax) {
      throw OperatorError("--inputs: a line is longer than DRIVE LIFT BUTTONS can be");
    }
  }
  Input result = held_;
  if (!ended_) result.buttons = now.buttons;
  return result;
}

}  // namespace seam
