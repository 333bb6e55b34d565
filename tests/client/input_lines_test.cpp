/// Inputs of another program, line by line.

#include "client/input_lines.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "common/base/check.h"
#include "common/sync/inputs/input_line.h"

namespace seam {
namespace input_lines_test {

/// A pipe whose end a client reads by its name.
class LinePipe : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(pipe2(ends_, O_CLOEXEC), 0);
    lines_ = std::make_unique<InputLines>("/dev/fd/" + std::to_string(ends_[0]));
  }
  void TearDown() override {
    close(ends_[0]);
    if (ends_[1] >= 0) close(ends_[1]);
  }
  void Say(const std::string& text) {
    ASSERT_EQ(write(ends_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  int ends_[2] = {-1, -1};
  std::unique_ptr<InputLines> lines_;
};

TEST_F(LinePipe, TheNewestLineHoldsUntilTheNext) {
  EXPECT_TRUE(lines_->Poll() == Input());
  Say("127 0 0\n-12");
  EXPECT_TRUE(lines_->Poll() == (Input{127, 0, 0}));
  EXPECT_TRUE(lines_->Poll() == (Input{127, 0, 0}));
  Say("7 5 3\n");
  EXPECT_TRUE(lines_->Poll() == (Input{-127, 5, 3}));
}

TEST_F(LinePipe, APressBetweenTwoLooksCounts) {
  Say("0 0 1\n0 0 0\n");
  EXPECT_TRUE(lines_->Poll() == (Input{0, 0, 1}));
  EXPECT_TRUE(lines_->Poll() == Input());
}

TEST_F(LinePipe, NothingIsHeldWhenTheWriterIsGone) {
  Say("127 0 1\n");
  EXPECT_TRUE(lines_->Poll() == (Input{127, 0, 1}));
  close(ends_[1]);
  ends_[1] = -1;
  EXPECT_TRUE(lines_->Poll() == Input());
  EXPECT_EQ(lines_->fd(), -1);
}

TEST_F(LinePipe, AnotherFormIsAMistake) {
  Say("left\n");
  EXPECT_THROW(lines_->Poll(), OperatorError);
  Input input;
  for (const char* line :
       {"", "1 2", "1 2 3 4", "128 0 0", "0 -128 0", "0 0 1024", "0 0 -1", "1e1 0 0", "0x1 0 0"})
    EXPECT_FALSE(ParseInputLine(line, &input)) << line;
}

TEST(InputLines, AFileThatIsNotThereIsAMistake) {
  EXPECT_THROW(InputLines("no/such/file"), OperatorError);
}

}  // namespace input_lines_test
}  // namespace seam
