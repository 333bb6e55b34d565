#include "client/input_lines.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "common/base/check.h"

namespace seam {
namespace {

constexpr std::size_t kInputLineBytesMax = 40;

}  // namespace

bool ParseInputLine(const std::string& line, Input* input) {
  int drive = 0, lift = 0, buttons = 0;
  char rest = 0;
  if (line.size() > kInputLineBytesMax) return false;
  if (std::sscanf(line.c_str(), "%4d %4d %4d %c", &drive, &lift, &buttons, &rest) != 3)
    return false;
  if (drive < -127 || drive > 127 || lift < -127 || lift > 127) return false;
  if (buttons < 0 || buttons > 1023) return false;
  input->drive = static_cast<std::int8_t>(drive);
  input->lift = static_cast<std::int8_t>(lift);
  input->buttons = static_cast<std::int16_t>(buttons);
  return true;
}

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
