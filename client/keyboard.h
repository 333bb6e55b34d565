#pragma once
/// The terminal as a game controller: arrow keys or WASD, space and digits as buttons.

#include <cstdint>
#include <memory>

#include "common/scene/types.h"

namespace seam {

/// Puts the terminal into raw mode while it lives. Terminals report key presses only, no releases:
/// a key counts as held until kHoldUs after its last repetition.
class Keyboard {
 public:
  /// Throws OperatorError if standard input is not a terminal.
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// Reads the keys typed and returns the state of the controls. `q`, Ctrl-C and the closing of the
  /// terminal set quit(). `running` false: nothing can be driven yet, so a key stays held until it
  /// can, and counts then. Of two opposite keys the later one counts.
  Input Poll(std::int64_t now_us, bool running = true);
  bool quit() const { return quit_; }
  int fd() const { return 0; }

  static constexpr std::int64_t kHoldUs = 150000;

 private:
  void Press(char key, std::int64_t now_us);
  /// Lets what is held last for kHoldUs from now on.
  void HoldOn(std::int64_t now_us);

  struct Saved;
  std::unique_ptr<Saved> saved_;
  std::int64_t right_us_ = 0, left_us_ = 0, up_us_ = 0, down_us_ = 0;
  std::int64_t button_us_[10] = {};
  bool waited_ = false;  // nothing could be driven at the last call
  int escape_ = 0;  // number of bytes received of an arrow's ESC [ or ESC O
  bool quit_ = false;
};

}  // namespace seam
