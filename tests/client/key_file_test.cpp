/// A player's key file must be readable by its owner alone, or it is refused.

#include "client/key_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "common/base/check.h"
#include "tests/support/program.h"

namespace seam {
namespace key_file_test {

class KeyFileTest : public ::testing::Test {
 protected:
  /// Returns the reason that the file is refused; "": accepted.
  std::string Refusal(const std::string& name) {
    try {
      KeyFile file(folder_ / name);
    } catch (const OperatorError& e) {
      return e.what();
    }
    return "";
  }
  void Write(const std::string& name, const std::string& text, mode_t mode = 0600) {
    folder_.Write(name, text);
    EXPECT_EQ(chmod((folder_ / name).c_str(), mode), 0);
  }
  Workspace folder_;
};

constexpr std::int64_t kKey = static_cast<std::int64_t>(0xfedcba9876543210u);

TEST_F(KeyFileTest, IsCreatedForItsOwnerAloneAndReadBack) {
  {
    KeyFile file(folder_ / "ann.key");
    EXPECT_EQ(file.key(), 0);
    EXPECT_NE(access((folder_ / "ann.key").c_str(), F_OK), 0) << "nothing is written before";
    file.Write(kKey);
    EXPECT_EQ(file.key(), kKey);
  }
  struct stat info {};
  ASSERT_EQ(stat((folder_ / "ann.key").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  KeyFile again(folder_ / "ann.key");
  EXPECT_EQ(again.key(), kKey);
  again.Write(7);
  EXPECT_EQ(KeyFile(folder_ / "ann.key").key(), 7);
}

TEST_F(KeyFileTest, RefusesFilesThatOthersMayReadOrThatAreNotRegular) {
  const std::string good = "fedcba9876543210\n";
  Write("good", good);
  EXPECT_EQ(Refusal("good"), "");
  for (const mode_t mode : {0640, 0604, 0620, 0602, 0666}) {
    Write("open", good, mode);
    EXPECT_NE(Refusal("open").find("chmod 600"), std::string::npos) << mode;
  }
  ASSERT_EQ(symlink((folder_ / "good").c_str(), (folder_ / "link").c_str()), 0);
  EXPECT_NE(Refusal("link").find("is a symbolic link"), std::string::npos);
  ASSERT_EQ(symlink((folder_ / "nowhere").c_str(), (folder_ / "dangling").c_str()), 0);
  EXPECT_NE(Refusal("dangling").find("is a symbolic link"), std::string::npos);
  ASSERT_EQ(mkdir((folder_ / "folder").c_str(), 0700), 0);
  EXPECT_NE(Refusal("folder"), "");
  ASSERT_EQ(mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  EXPECT_NE(Refusal("fifo").find("is no plain file"), std::string::npos);
  EXPECT_NE(Refusal("missing/ann.key"), "");
}

TEST_F(KeyFileTest, RefusesToReplaceAFileThatAppearsAfterTheStart) {
  KeyFile file(folder_ / "ann.key");
  ASSERT_EQ(symlink("/dev/null", (folder_ / "ann.key").c_str()), 0);
  EXPECT_THROW(file.Write(kKey), OperatorError);
}

TEST_F(KeyFileTest, RefusesAnythingButAKey) {
  for (const char* text : {"x", "fedcba9876543210", "fedcba987654321\n", "FEDCBA9876543210\n",
                           "fedcba9876543210\nmore", "fedcba987654321g\n"}) {
    Write("bad", text);
    EXPECT_NE(Refusal("bad").find("does not hold a key"), std::string::npos) << text;
  }
  Write("empty", "");
  EXPECT_EQ(Refusal("empty"), "") << "an interrupted writer's: no key yet";
}

}  // namespace key_file_test
}  // namespace seam
