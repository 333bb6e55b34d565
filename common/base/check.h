#pragma once
/// Error handling: our own bugs are asserted in every build, an operator's mistakes are thrown.
/// Wrong bytes from the network or a log are neither: the reader drops and counts them.

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

/// Prints file and line and aborts if `condition` is false, in every build. For our own bugs.
#define SEAM_ASSERT(condition)                                                               \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)

namespace seam {

/// An operator's mistake (a flag, a scene, a port). Its message is one line that names the remedy;
/// every main prints it and exits with status 2.
class OperatorError : public std::runtime_error {
 public:
  explicit OperatorError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace seam
