/// A key in a file that is nobody else's.

#include "common/net/secret_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>

#include "common/base/check.h"
#include "tests/support/program.h"

namespace seam {
namespace secret_file_test {

std::string ErrorOf(const std::string& path) {
  try {
    (void)ReadSecretFile("--key", path);
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

TEST(SecretFile, GivesBackTheKeyAndIsReadableByItsOwnerAlone) {
  const Workspace folder;
  SeededEntropy entropy(1);
  const Secret secret(entropy);
  MakeSecretFile("--key", folder / "a.key", secret);
  EXPECT_EQ(ReadSecretFile("--key", folder / "a.key"), secret);
  struct stat info {};
  ASSERT_EQ(stat((folder / "a.key").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  EXPECT_THROW(MakeSecretFile("--key", folder / "a.key", secret), OperatorError)
      << "never replaced";
}

TEST(SecretFile, IsKeptOnceItExists) {
  const Workspace folder;
  SeededEntropy entropy(1);
  const Secret first = KeepSecretFile("--identity", folder / "a.key", entropy);
  EXPECT_EQ(KeepSecretFile("--identity", folder / "a.key", entropy), first);
  EXPECT_NE(KeepSecretFile("--identity", folder / "b.key", entropy), first);
  EXPECT_THROW((void)KeepSecretFile("--identity", folder / "none/c.key", entropy), OperatorError);
}

TEST(SecretFile, AnythingElseIsRefusedByName) {
  const Workspace folder;
  const std::string digits(64, 'a');
  const auto written = [&](const std::string& name, const std::string& text, mode_t mode) {
    folder.Write(name, text);
    EXPECT_EQ(chmod((folder / name).c_str(), mode), 0);
    return ErrorOf(folder / name);
  };
  EXPECT_EQ(written("good", digits + "\n", 0600), "");
  EXPECT_EQ(written("bare", digits, 0600), "");
  for (const mode_t mode : {0640, 0604, 0620, 0666}) {
    EXPECT_NE(written("open", digits, mode).find("others may read or write it"), std::string::npos);
  }
  for (const std::string& text : {std::string(), digits.substr(1), digits + "a", digits + "\n\n",
                                  std::string(64, 'g'), std::string(5000, 'a')}) {
    const std::string line = written("bad", text, 0600);
    EXPECT_NE(line.find("does not hold a key"), std::string::npos) << text;
    EXPECT_NE(line.find("--key "), std::string::npos);
    EXPECT_EQ(line.find("aaa"), std::string::npos) << "says nothing of the key";
  }
  ASSERT_EQ(symlink("good", (folder / "link").c_str()), 0);
  EXPECT_NE(ErrorOf(folder / "link").find("symbolic link"), std::string::npos);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_NE(ErrorOf(folder / "pipe").find("no plain file"), std::string::npos);
  EXPECT_NE(ErrorOf(folder.path()).find("--key "), std::string::npos);
  EXPECT_NE(ErrorOf(folder / "missing").find("No such file"), std::string::npos);
}

}  // namespace secret_file_test
}  // namespace seam
