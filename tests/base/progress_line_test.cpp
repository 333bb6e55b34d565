/// The progress line renews itself on a terminal and is silent everywhere else.

#include "common/base/progress_line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "common/base/progress_count.h"

namespace seam {
namespace progress_line_test {

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
  void SetColumns(int columns) const {
    winsize size{};
    size.ws_col = static_cast<unsigned short>(columns);
    size.ws_row = 24;
    ioctl(window_, TIOCSWINSZ, &size);
  }
  /// Returns the text written since the last call; waits for at least one character.
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

TEST(ProgressLine, IsCutAtTheTerminalsWidth) {
  const TerminalErrors terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminal here";
  terminal.SetColumns(12);
  ProgressLine line(false, 1000);
  line.Show(0, "0123456789abcdef");
  EXPECT_EQ(terminal.Read(), "\r0123456789a") << "a full line would be wrapped by the next";
  line.Show(1000, "0");
  EXPECT_EQ(terminal.Read(), "\r0          ");
}

TEST(ProgressCount, PrintsTaskCountTotalRateAndTimeLeft) {
  EXPECT_EQ(ProgressText("sweep", "runs", 0, 400, 3), "sweep: 0 of 400 runs (0 %)");
  EXPECT_EQ(ProgressText("sweep", "runs", 12, 400, 4),
            "sweep: 12 of 400 runs (3 %), 3.0 runs/s, 2 min 10 s left");
  EXPECT_EQ(ProgressText("drawing", "frames", 1200, 1500, 10),
            "drawing: 1200 of 1500 frames (80 %), 120 frames/s, 3 s left");
  EXPECT_EQ(ProgressText("drawing", "frames", 1500, 1500, 10),
            "drawing: 1500 of 1500 frames (100 %), 150 frames/s");
  EXPECT_EQ(ProgressText("drawing", "frames", 1, 9, 0.001), "drawing: 1 of 9 frames (11 %)");
  EXPECT_EQ(ProgressText("search", "trials", 5, 0, 2), "search: 5 trials, 2.5 trials/s");
}

TEST(ProgressCount, SpansHaveTwoUnitsAtMost) {
  EXPECT_EQ(SpanText(-1), "0 ms");
  EXPECT_EQ(SpanText(0.5), "500 ms");
  EXPECT_EQ(SpanText(59.9), "59 s");
  EXPECT_EQ(SpanText(121), "2 min 1 s");
  EXPECT_EQ(SpanText(12000), "3 h 20 min");
}

TEST(ProgressCount, WritesItsLineOnATerminalAndNothingToAFile) {
  ::testing::internal::CaptureStderr();
  {
    ProgressCount count("sweep", "runs", 4);
    count(1);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  const TerminalErrors terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminal here";
  ProgressCount count("sweep", "runs", 4);
  count(0);
  EXPECT_EQ(terminal.Read(), "\rsweep: 0 of 4 runs (0 %)");
  count(1);  // not due yet
  count.End();
  EXPECT_EQ(terminal.Read(), "\r\n");
}

}  // namespace progress_line_test
}  // namespace seam
