#pragma once
/// Suites that need a network of their own: all their tests run in one network namespace, where
/// multicast and every port are free, and the machine's network hears nothing.

#include <gtest/gtest.h>

#include <string>

namespace seam {

class InNamespace : public ::testing::Test {
 protected:
  /// Sets up multicast over loopback, as in docs/recordings.md.
  static constexpr const char* kMulticast = "ip link set lo up; ip route add 224.0.0.0/4 dev lo";

  /// Returns true inside the namespace, where the test does its work. Outside, runs all selected
  /// tests of this suite inside, once, after the shell commands `network`; then returns false with
  /// this test's verdict given: a failure, or skip_reason().
  bool Enter(const std::string& network = kMulticast);
  const std::string& skip_reason() const { return skip_reason_; }

 private:
  std::string skip_reason_;
};

/// Runs the rest of the test only inside the namespace; takes Enter's argument.
#define SEAM_INSIDE_ONLY(...)                                  \
  if (!Enter(__VA_ARGS__)) {                                   \
    if (!skip_reason().empty()) GTEST_SKIP() << skip_reason(); \
    return;                                                    \
  }

}  // namespace seam
