/// A directory file whose lock somebody keeps.

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

TEST(DirectoryFile, ALockThatIsNotGivenBackIsOneErrorInTime) {
  Workspace folder;
  FleetServer server;
  server.id = "a";
  server.address = "127.0.0.1:7001";
  server.version = kVersion;
  server.protocol = kProtocolVersion;
  server.capacity = 8;
  Directory directory(OpenKeyStore("file:" + folder.path()), "test");
  ASSERT_TRUE(directory.Register(server).ok());
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

}  // namespace directory_lock_test
}  // namespace seam
