#pragma once
/// What to do about errors: assert our own bugs in every build, throw an operator's mistakes.
/// Wrong bytes from the network or a log are neither: they are dropped and counted where read.

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

/// Our own bug: prints file and line and aborts, in every build.
#define SEAM_ASSERT(condition)                                                               \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)

namespace seam {

/// An operator's mistake (a flag, a scene, a port). `what()` is one line that says what to change;
/// every main prints it and exits with status 2.
class OperatorError : public std::runtime_error {
 public:
  explicit OperatorError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace seam
