/// The progress line renews itself on a terminal and is silent everywhere else.

#include "common/base/progress_line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace seam {
namespace {

/// While it lives, stderr is a terminal.
class TerminalErrors {
 public:
  TerminalErrors()
      : window_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)), saved_(dup(STDERR_FILENO)) {
    if (window_ < 0 || grantpt(window_) != 0 || unlockpt(window_) != 0) return;
    const int terminal = open(ptsname(window_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    good_ = dup2(terminal, STDERR_FILENO) >= 0;
    close(terminal);
  }
  ~TerminalErrors() {
    dup2(saved_, STDERR_FILENO);
    close(saved_);
    close(window_);
  }
  TerminalErrors(const TerminalErrors&) = delete;
  TerminalErrors& operator=(const TerminalErrors&) = delete;
  bool good() const { return good_; }
  /// What was written since the last time; at least one character is waited for.
  std::string Read() const {
    char text[1000];
    const ssize_t bytes = read(window_, text, sizeof text);
    return std::string(text, bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
  }

 private:
  int window_, saved_;
  bool good_ = false;
};

TEST(ProgressLine, IsSilentInAFile) {
  ::testing::internal::CaptureStderr();
  {
    ProgressLine line;
    EXPECT_FALSE(line.Due(0));
    EXPECT_FALSE(line.Due(1000000000));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ProgressLine, OnATerminalRenewsItselfWhenDueAndEndsOnce) {
  const TerminalErrors terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminal here";
  {
    ProgressLine line(false, 1000);
    ASSERT_TRUE(line.Due(0));
    line.Show(0, "tick 10");
    EXPECT_EQ(terminal.Read(), "\rtick 10");
    EXPECT_FALSE(line.Due(999));
    ASSERT_TRUE(line.Due(1000));
    line.Show(1000, "tick");  // what stood there is overwritten
    EXPECT_EQ(terminal.Read(), "\rtick   ");
    line.End();
    EXPECT_EQ(terminal.Read(), "\r\n");  // as a terminal shows a line's end
  }
  std::fputs("next", stderr);  // the destructor did not end it again
  EXPECT_EQ(terminal.Read(), "next");
}

TEST(ProgressLine, QuietIsSilentOnATerminalToo) {
  const TerminalErrors terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminal here";
  const ProgressLine line(true);
  EXPECT_FALSE(line.Due(1000000000));
}

}  // namespace
}  // namespace seam
