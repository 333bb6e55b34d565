#pragma once
/// A headless Chromium that a test drives as a person would: opens a page from disk or of a server
/// on this machine, uses mouse and keys, and reads the page, its errors, and its requests outside
/// the file or the server. Controlled over two
/// pipes (the DevTools protocol), so that no port is opened.

#include <string>
#include <vector>

#include "tests/support/program.h"

namespace seam {

class Browser {
 public:
  /// Returns the program's name; "" if there is none: then a test is skipped.
  static std::string Find();

  /// Starts it with a window of that size, px.
  Browser(int width, int height);
  /// Ends it.
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Opens a file's page, or an address "http://...", with the part of its address after #, and
  /// waits until `ready` (an expression) is true; returns false if it never is.
  bool Open(const std::string& path, const std::string& fragment, const std::string& ready);
  /// Returns the value of an expression, as text.
  std::string Evaluate(const std::string& expression);
  /// Returns the value of an expression, as a number.
  double Number(const std::string& expression);
  /// Waits for the next frame after the last action.
  void Settle();
  /// Clicks the middle of the first element that a selector finds.
  void Click(const std::string& selector);
  /// Drags the mouse from one place of an element (shares of its size) to another.
  void Drag(const std::string& selector, double from_x, double to_x, double y = 0.5);
  /// Presses the mouse at a place of an element (shares of its size), moves it there, or releases
  /// it: "mousePressed", "mouseMoved", "mouseReleased".
  void Point(const std::string& type, const std::string& selector, double x, double y);
  /// Presses and releases a key: "ArrowRight", " ", "w".
  void Press(const std::string& key);
  /// Prefers dark pages, or light ones, from now on.
  void PreferDark(bool dark);
  /// Presses a key, or releases it.
  void Hold(const std::string& key, bool down);

  /// Console errors, exceptions, and requests for anything outside the file.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  /// Sends a command and waits; returns its whole answer.
  std::string Call(const std::string& method, const std::string& parameters);
  std::string NextMessage();
  void Listen(const std::string& message);
  void Mouse(const std::string& type, double x, double y);

  Workspace profile_;
  int pid_ = -1, to_ = -1, from_ = -1, commands_ = 0;
  std::string session_, heard_;
  std::string server_;  // "http://127.0.0.1:8080/" of a page that has one; else ""
  std::vector<std::string> complaints_;
};

}  // namespace seam
