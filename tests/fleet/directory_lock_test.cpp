/// Directory files that cannot be locked or read, and who may.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <mutex>
#include <thread>

#include "common/base/limits.h"
#include "common/base/process.h"
#include "common/base/version.h"
#include "common/codec/messages.h"
#include "common/fleet/directory.h"
#include "common/fleet/folder_lock.h"
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
  bool alive = false;
  const Status status = directory.Renew(&alive);
  EXPECT_EQ(status.why(),
            folder / "directory.lock" + ": cannot be locked; another program holds it");
  EXPECT_LT(SteadyClockUs() - begin_us, 5000000);
  close(other);
  EXPECT_TRUE(directory.Renew(&alive).ok());
}

TEST(DirectoryFile, AReaderWaitsForNoLock) {
  Workspace folder;
  Directory directory(OpenKeyStore("file:" + folder.path()), "test");
  ASSERT_TRUE(directory.Register(ServerA()).ok());
  const int other = open((folder / "directory.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  FleetListing listing;
  EXPECT_TRUE(directory.List(&listing).ok());
  EXPECT_EQ(listing.servers.size(), 1u);
  close(other);
}

/// The number of those that stand in the system's queue for the lock of an open file.
int WaitersFor(int fd) {
  struct stat file {};
  EXPECT_EQ(fstat(fd, &file), 0);
  const std::string inode = ":" + std::to_string(file.st_ino) + " ";
  std::ifstream locks("/proc/locks");
  int waiters = 0;
  for (std::string line; std::getline(locks, line);) {
    const bool waits = line.find("-> FLOCK ") != std::string::npos;
    if (waits && line.find(inode) != std::string::npos) ++waiters;
  }
  return waiters;
}

TEST(DirectoryFile, TheLockIsHadInTheOrderInWhichItWasAskedFor) {
  constexpr int kWaiters = 7;
  Workspace folder;
  const std::string path = folder / "directory.lock";
  const int other = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  std::mutex mutex;  // for what has the lock by mistake
  std::vector<int> order;
  std::vector<std::thread> waiters;
  for (int i = 1; i <= kWaiters; ++i) {
    waiters.emplace_back([&, i] {
      FolderLock lock(path);
      const Status status = lock.With(0600, [&] {
        const std::lock_guard<std::mutex> guard(mutex);
        order.push_back(i);
        return Status::Ok();
      });
      EXPECT_TRUE(status.ok()) << status.why();
    });
    // Together less than one waits for the lock, where nothing tells of the queue.
    for (int n = 0; n < 100 && WaitersFor(other) < i; ++n) usleep(1000);
  }
  close(other);
  for (std::thread& waiter : waiters) waiter.join();
  EXPECT_EQ(order, (std::vector<int>{1, 2, 3, 4, 5, 6, 7}));
}

TEST(DirectoryFile, ATransactionThatIsRefusedWritesNothing) {
  Workspace folder;
  const std::unique_ptr<KeyStore> store = OpenKeyStore("file:" + folder.path());
  bool done = false;
  ASSERT_TRUE(store->Commit({}, {{"/a", "1", 0}}, &done).ok());
  struct stat before {
  }, after{};
  ASSERT_EQ(stat((folder / "directory.json").c_str(), &before), 0);
  ASSERT_TRUE(
      store->Commit({{"/a", KeyCondition::Is::kAbsent, "", 0}}, {{"/a", "2", 0}}, &done).ok());
  EXPECT_FALSE(done);
  ASSERT_EQ(stat((folder / "directory.json").c_str(), &after), 0);
  EXPECT_EQ(before.st_ino, after.st_ino);
}

TEST(DirectoryFile, ItsModeFollowsFolderAndUmask) {
  struct Case {
    mode_t folder, umask, file, lock;
  };
  for (const Case& each :
       {Case{0777, 0022, 0644, 0644}, Case{0777, 0, 0666, 0666}, Case{0770, 0007, 0660, 0660},
        Case{0755, 0022, 0644, 0600}, Case{0700, 0022, 0600, 0600}, Case{0777, 0077, 0600, 0600}}) {
    Workspace folder;
    ASSERT_EQ(chmod(folder.path().c_str(), each.folder), 0);
    const mode_t before = umask(each.umask);
    Directory directory(OpenKeyStore("file:" + folder.path()), "test");
    EXPECT_TRUE(directory.Register(ServerA()).ok());
    umask(before);
    for (const auto& [name, mode] :
         {std::pair("directory.json", each.file), std::pair("directory.lock", each.lock)}) {
      struct stat status {};
      ASSERT_EQ(stat((folder / name).c_str(), &status), 0);
      EXPECT_EQ(status.st_mode & 07777, mode) << name << " in " << std::oct << each.folder;
    }
  }
}

TEST(DirectoryFile, AnotherUserReadsItAndIsToldTheTruthWhenItMayNotWrite) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may be somebody else";
  Workspace folder;
  ASSERT_EQ(chmod(folder.path().c_str(), 0755), 0);
  const mode_t before = umask(0022);
  Directory directory(OpenKeyStore("file:" + folder.path()), "test");
  ASSERT_TRUE(directory.Register(ServerA()).ok());
  umask(before);
  const pid_t child = fork();
  if (child == 0) {
    if (setgid(65534) != 0 || setuid(65534) != 0) _exit(9);
    Directory other(OpenKeyStore("file:" + folder.path()), "test");
    FleetListing listing;
    if (!other.List(&listing).ok() || listing.servers.size() != 1) _exit(1);
    FleetServer b = ServerA();
    b.id = "b";
    _exit(other.Register(b).why() ==
                  folder / "directory.lock" + ": cannot be opened: Permission denied"
              ? 0
              : 2);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
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
