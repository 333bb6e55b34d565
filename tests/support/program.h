#pragma once
/// A program that a test runs as a user would: with separate output and errors, a chosen folder and
/// terminal, and a timeout; stopped by its process id.

#include <memory>
#include <string>
#include <vector>

namespace seam {

/// Returns the absolute path of a program built with these tests, such as "seam-server": in
/// $SEAM_BIN, or beside the tests.
std::string BuiltProgram(const std::string& name);

class Program {
 public:
  /// Starts argv[0] (looked up in PATH) in `folder` ("": the current one). Its standard input is
  /// the open `terminal`, or empty if that is -1.
  explicit Program(const std::vector<std::string>& argv, const std::string& folder = "",
                   int terminal = -1);
  /// Kills the program if it still runs.
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits at most `seconds` for the program's end; returns true if it has ended.
  bool Wait(double seconds);
  /// Waits at most `seconds` until its errors contain `text`; returns true if they do.
  bool WaitForErrors(const std::string& text, double seconds);
  void Signal(int signal);

  /// -1 when it has ended.
  int pid() const { return pid_; }
  /// Exit status; 128 + signal if the program was killed; -1 while it runs.
  int status() const { return status_; }
  std::string output() const;  ///< text written to stdout so far
  std::string errors() const;  ///< text written to stderr so far
  /// Returns the status and both texts, for a failure's message.
  std::string Story() const;

 private:
  int output_fd_, errors_fd_;
  int pid_ = -1;
  int status_ = -1;
};

/// A pseudo terminal: the program that has `terminal()` as its input reads the text typed here.
class PseudoTerminal {
 public:
  PseudoTerminal();
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  bool good() const { return terminal_ >= 0; }
  int terminal() const { return terminal_; }
  void Type(const std::string& keys);
  /// True if the terminal is in line mode with echo, as a shell's terminal is.
  bool IsCooked() const;
  /// Closes this end, as when the window is closed.
  void HangUp();

 private:
  int keyboard_ = -1, terminal_ = -1;
};

/// A temporary folder of a test, removed with the object.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  void Write(const std::string& name, const std::string& text) const;
  /// Returns every file and folder with its content: equal before and after if nothing was written.
  std::vector<std::string> Content() const;

 private:
  std::string path_;
};

}  // namespace seam
