#include "client/keyboard.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "common/base/check.h"

namespace seam {

struct Keyboard::Saved {
  termios settings{};
};

Keyboard::Keyboard() : saved_(std::make_unique<Saved>()) {
  if (isatty(0) == 0 || tcgetattr(0, &saved_->settings) != 0) {
    throw OperatorError("--drive keyboard needs a terminal on standard input");
  }
  termios raw = saved_->settings;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(0, TCSANOW, &raw);
}

Keyboard::~Keyboard() { tcsetattr(0, TCSANOW, &saved_->settings); }

void Keyboard::Press(char key, std::int64_t now_us) {
  if (key == '\033') {
    escape_ = 1;
    return;
  }
  if (escape_ == 1 && (key == '[' || key == 'O')) {
    escape_ = 2;
    return;
  }
  if (escape_ == 2) {  // ESC [ A..D, with modifiers ESC [ 1 ; 2 A
    if ((key >= '0' && key <= '9') || key == ';') return;
    key = key == 'A' ? 'w' : key == 'B' ? 's' : key == 'C' ? 'd' : key == 'D' ? 'a' : '\0';
  }
  escape_ = 0;
  const auto hold = [now_us](std::int64_t* key_us, std::int64_t* opposite_us) {
    *key_us = now_us + kHoldUs;
    *opposite_us = 0;
  };
  if (key == 'd') hold(&right_us_, &left_us_);
  if (key == 'a') hold(&left_us_, &right_us_);
  if (key == 'w') hold(&up_us_, &down_us_);
  if (key == 's') hold(&down_us_, &up_us_);
  if (key == ' ') button_us_[0] = now_us + kHoldUs;
  if (key >= '0' && key <= '9') button_us_[key - '0'] = now_us + kHoldUs;
  if (key == 'q' || key == '\003') quit_ = true;
}

void Keyboard::HoldOn(std::int64_t now_us) {
  for (std::int64_t* key_us : {&right_us_, &left_us_, &up_us_, &down_us_}) {
    if (*key_us > 0) *key_us = now_us + kHoldUs;
  }
  for (std::int64_t& key_us : button_us_) {
    if (key_us > 0) key_us = now_us + kHoldUs;
  }
}

Input Keyboard::Poll(std::int64_t now_us, bool running) {
  char keys[64];
  const ssize_t count = read(0, keys, sizeof keys);
  for (ssize_t i = 0; i < count; ++i) Press(keys[i], now_us);
  if (!running || waited_) HoldOn(now_us);
  waited_ = !running;
  pollfd terminal{0, 0, 0};  // reports a hang-up unasked; read() alone returns 0 for that, too
  if (poll(&terminal, 1, 0) > 0) quit_ = true;
  Input input;
  input.drive =
      static_cast<std::int8_t>((right_us_ > now_us ? 127 : 0) - (left_us_ > now_us ? 127 : 0));
  input.lift =
      static_cast<std::int8_t>((up_us_ > now_us ? 127 : 0) - (down_us_ > now_us ? 127 : 0));
  int buttons = 0;
  for (int b = 0; b < 10; ++b) buttons |= button_us_[b] > now_us ? 1 << b : 0;
  input.buttons = static_cast<std::int16_t>(buttons);
  return input;
}

}  // namespace seam
