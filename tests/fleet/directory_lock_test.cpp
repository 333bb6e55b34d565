/// Directory files that cannot be locked or read, and who may.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/base/limits.h"
#include "common/base/process.h"
#include "common/base/version.h"
#include "common/codec/messages.h"
#include "common/fleet/directory.h"
#include "tests/support/program.h"

namespace seam {
namespace directory_lock_test {

FleetServer ServerA() {
  FleetServer server;
  server.id = "a";
  server.address = "127.0.0.1:7001";
  server.version = kVersion;
  server.protocol = kProtocolVersion;
  server.capacity = 8;
  return server;
}

TEST(DirectoryFile, ALockThatIsNotGivenBackIsOneErrorInTime) {
  Workspace folder;
  Directory directory(OpenKeyStore("file:" + folder.path()), "test");
  ASSERT_TRUE(directory.Register(ServerA()).ok());
  const int other = open((folder / "directory.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  const std::int64_t begin_us = SteadyClockUs();
  FleetListing listing;
  const Status status = directory.List(&listing);
  EXPECT_NE(status.why().find("directory.lock: cannot be locked"), std::string::npos);
  EXPECT_LT(SteadyClockUs() - begin_us, 5000000);
  close(other);
  EXPECT_TRUE(directory.List(&listing).ok());
}

TEST(DirectoryFile, AFileThatCannotBeQueriedIsADirectoryThatIsDown) {
  Workspace folder;
  Directory directory(OpenKeyStore("file:" + folder.path()), "test");
  ASSERT_TRUE(directory.Register(ServerA()).ok());
  const std::string file = folder / "directory.json", kept = folder / "kept.json";
  ASSERT_EQ(std::rename(file.c_str(), kept.c_str()), 0);
  ASSERT_EQ(symlink("directory.json", file.c_str()), 0);
  FleetListing listing;
  bool alive = false;
  EXPECT_EQ(directory.List(&listing).why(),
            file + ": cannot be read: Too many levels of symbolic links");
  EXPECT_FALSE(directory.Renew(&alive).ok());
  ASSERT_EQ(std::rename(kept.c_str(), file.c_str()), 0);
  EXPECT_TRUE(directory.Renew(&alive).ok());
  EXPECT_TRUE(alive);
}

}  // namespace directory_lock_test
}  // namespace seam
