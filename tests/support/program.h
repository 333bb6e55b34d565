#pragma once
/// A program that a test runs as a user would: its output and its errors apart, its folder and its
/// terminal chosen, its end awaited within bounds, and stopped by its process id.

#include <memory>
#include <string>
#include <vector>

namespace seam {

/// "seam-server" -> the absolute path of the program that was built with these tests: in $SEAM_BIN,
/// or beside the tests.
std::string BuiltProgram(const std::string& name);

class Program {
 public:
  /// Starts argv[0] (looked up in PATH) in `folder` ("": here). Its standard input is the open
  /// `terminal`, or empty when that is -1.
  explicit Program(const std::vector<std::string>& argv, const std::string& folder = "",
                   int terminal = -1);
  /// Kills it when it still runs.
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits at most `seconds` for its end; true when it has ended.
  bool Wait(double seconds);
  /// Waits at most `seconds` until its errors contain `text`; true when they do.
  bool WaitForErrors(const std::string& text, double seconds);
  void Signal(int signal);

  /// -1 when it has ended.
  int pid() const { return pid_; }
  /// Of its exit, 128 + signal when it was killed, -1 while it runs.
  int status() const { return status_; }
  std::string output() const;  ///< what it has written to stdout so far
  std::string errors() const;  ///< and to stderr
  /// For a failure's message: status and both texts.
  std::string Story() const;

 private:
  int output_fd_, errors_fd_;
  int pid_ = -1;
  int status_ = -1;
};

/// A pseudo terminal: what is typed here is read by the program that has `terminal()` as its input.
class PseudoTerminal {
 public:
  PseudoTerminal();
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  bool good() const { return terminal_ >= 0; }
  int terminal() const { return terminal_; }
  void Type(const std::string& keys);
  /// Whether it commands over whole lines and echoes, as a shell's terminal does.
  bool IsCooked() const;
  /// Closes this end, as when the window is closed.
  void HangUp();

 private:
  int keyboard_ = -1, terminal_ = -1;
};

/// A folder of a test, gone with the object.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  void Write(const std::string& name, const std::string& text) const;
  /// Every file and folder in it with its content: equal before and after when nothing was written.
  std::vector<std::string> Content() const;

 private:
  std::string path_;
};

}  // namespace seam
