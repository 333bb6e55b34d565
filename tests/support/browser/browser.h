#pragma once
/// A headless Chromium that a test drives as a person would: a page opened from disk, the mouse and
/// the keys, what stands in the page; and everything that went wrong in it or left the file. It is
/// spoken to over two pipes (the DevTools protocol), so that no port is opened.

#include <string>
#include <vector>

#include "tests/support/program.h"

namespace seam {

class Browser {
 public:
  /// The program's name; "" where there is none: then a test is skipped.
  static std::string Find();

  /// Starts it with a window of that size, px.
  Browser(int width, int height);
  /// Ends it.
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Opens a file's page, with what stands behind # in its address, and waits until `ready` (an
  /// expression) is true; false when it never is.
  bool Open(const std::string& path, const std::string& fragment, const std::string& ready);
  /// The value of an expression, as text.
  std::string Evaluate(const std::string& expression);
  /// The same as a number.
  double Number(const std::string& expression);
  /// Waits for the next picture after what was done.
  void Settle();
  /// Clicks the middle of the first element that a selector finds.
  void Click(const std::string& selector);
  /// Presses the mouse at one place of an element (shares of its size), moves, lets go at another.
  void Drag(const std::string& selector, double from_x, double to_x, double y = 0.5);
  /// One key down and up: "ArrowRight", " ", "w".
  void Press(const std::string& key);

  /// Console errors, exceptions, and requests for anything that is not in the file.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  /// Sends a command and waits for its answer, which it gives whole.
  std::string Call(const std::string& method, const std::string& parameters);
  std::string NextMessage();
  void Listen(const std::string& message);
  void Mouse(const std::string& type, double x, double y);

  Workspace profile_;
  int pid_ = -1, to_ = -1, from_ = -1, commands_ = 0;
  std::string session_, heard_;
  std::vector<std::string> complaints_;
};

}  // namespace seam
