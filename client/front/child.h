#pragma once
/// A program that another one starts, watches and ends.

#include <string>
#include <vector>

namespace seam {

/// Returns a descriptor from which a short text is read, and then the end.
int ReadableText(const std::string& text);

/// The files of a program that is started; -1: as ours, or none.
struct ChildFiles {
  int input = -1;         ///< standard input; -1: empty
  int output = -1;        ///< standard output; -1: none
  int errors = -1;        ///< standard error; -1: none
  int third = -1;         ///< descriptor 3; -1: none
  bool terminal = false;  ///< has our terminal as input and output instead
};

class Child {
 public:
  /// Starts a program; it ends by SIGTERM if we die. Throws OperatorError if it cannot be started.
  Child(const std::vector<std::string>& words, const ChildFiles& files);
  ~Child() { End(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// True while it runs.
  bool running();
  /// Returns its exit status; 128 + signal if it was killed; -1 while it runs.
  int status() const { return status_; }
  const std::string& name() const { return name_; }
  /// Asks it to end, and does not wait.
  void Interrupt();
  /// Ends it: SIGINT, and SIGKILL after 3 s. Returns status().
  int End();

 private:
  std::string name_;
  int pid_ = -1;
  int status_ = -1;
};

}  // namespace seam
