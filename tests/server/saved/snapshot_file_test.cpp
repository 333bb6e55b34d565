/// Snapshots of rooms as files: whole or refused.

#include "server/saved/snapshot_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "client/embed/cluster.h"
#include "common/base/check.h"
#include "common/codec/codec.h"
#include "server/saved/resumed_room.h"
#include "server/saved/trial_load.h"
#include "tests/support/arena.h"
#include "tests/support/file_bytes.h"
#include "tests/support/lone_room.h"
#include "tests/support/program.h"
#include "tests/support/soak/server_log.h"

namespace seam {
namespace snapshot_file_test {

/// Saves a room at ticks 60, 120 ... with a log that ends there.
void KeepArena(const Workspace& folder, std::int64_t last_tick) {
  LoneRoom room(Arena());
  RoomLog log(StateLogOf(folder.path(), "main"), true, nullptr);
  for (std::int64_t tick = 60; tick <= last_tick; tick += 60) {
    room.StepTo(tick);
    LogSeal chain;
    chain.session = 5;
    chain.tick = tick;
    log.EndTick("SEAM.main.chain.0", chain, true);
    ASSERT_TRUE(WriteSnapshot(folder.path(), "main", {tick, log.Pin(), room.Save()}).ok());
  }
}

TEST(SnapshotFile, TheLastTwoAreKept) {
  Workspace folder;
  KeepArena(folder, 240);
  const std::vector<SnapshotName> files = ListSnapshots(folder.path(), "main");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].tick, 240);
  EXPECT_EQ(files[1].tick, 180);
  EXPECT_TRUE(ListSnapshots(folder.path(), "mai").empty());
  EXPECT_EQ(ListSnapshots(folder.path(), "").size(), 2u);
  for (const std::string& name : folder.Content()) {
    EXPECT_EQ(name.find(".tmp"), std::string::npos);
  }
  const ResumedRoom room = ReadResumedRoom(folder.path(), "main");
  EXPECT_EQ(room.saved_tick, 240);
  EXPECT_TRUE(room.notes.empty());
  EXPECT_FALSE(room.new_log);
}

TEST(SnapshotFile, EveryFlippedBitIsRefused) {
  Workspace folder;
  KeepArena(folder, 60);
  const std::string path = ListSnapshots(folder.path(), "main")[0].path;
  const Bytes good = ReadBytes(path);
  Random random(9);
  RoomSnapshot snapshot;
  ASSERT_TRUE(ReadSnapshot(path, &snapshot).ok());
  EXPECT_EQ(snapshot.tick, 60);
  for (int i = 0; i < 400; ++i) {
    Bytes bad = good;
    bad[i < 60 ? static_cast<std::size_t>(i) % 48 : random.Next() % bad.size()] ^=
        static_cast<std::uint8_t>(1u << random.Next() % 8);
    WriteBytes(path, bad);
    ASSERT_FALSE(ReadSnapshot(path, &snapshot).ok()) << i;
  }
  WriteBytes(path, Bytes(good.begin(), good.begin() + 1000));
  EXPECT_FALSE(ReadSnapshot(path, &snapshot).ok());
}

TEST(SnapshotFile, ADamagedOrNewerOneGivesWayToTheOneBefore) {
  for (const int version : {0, 1}) {
    Workspace folder;
    KeepArena(folder, 120);
    const std::string path = ListSnapshots(folder.path(), "main")[0].path;
    Bytes bytes = ReadBytes(path);
    if (version != 0) bytes[8] = static_cast<std::uint8_t>(kSnapshotVersion + 1);
    if (version == 0) bytes[bytes.size() / 2] ^= 1;
    WriteBytes(path, bytes);
    const ResumedRoom room = ReadResumedRoom(folder.path(), "main");
    EXPECT_EQ(room.saved_tick, 60);
    ASSERT_EQ(room.notes.size(), 1u);
    EXPECT_NE(room.notes[0].find(version != 0 ? "is of version" : "is damaged"), std::string::npos)
        << room.notes[0];
    EXPECT_NE(room.notes[0].find("the one before is used"), std::string::npos) << room.notes[0];
    const std::string before = ListSnapshots(folder.path(), "main")[1].path;
    WriteBytes(before, {1, 2, 3});
    EXPECT_THROW(ReadResumedRoom(folder.path(), "main"), OperatorError);
  }
}

TEST(SnapshotFile, ALogOfAnEarlierEpochIsNotTheRoom) {
  Workspace folder;
  ServerLog log(StateLogOf(folder.path(), "main"));
  ClusterConfig config;
  config.keep = false;
  config.recorder = &log;
  Cluster cluster(config);
  cluster.RunToTick(60);
  folder.Write("main-000000000060.snapshot", "damaged");
  const ResumedRoom resumed = ReadResumedRoom(folder.path(), "main");
  EXPECT_EQ(resumed.saved_tick, 0);
  EXPECT_EQ(resumed.tick(), 60);
  EXPECT_FALSE(resumed.new_log);
  ASSERT_EQ(resumed.notes.size(), 2u);
  EXPECT_NE(resumed.notes[1].find("its whole log is done again"), std::string::npos);
  for (const char* later : {"main.e2.lcm", "main.e2-000000000120.snapshot"}) {
    folder.Write(later, "damaged");
    EXPECT_THROW(ReadResumedRoom(folder.path(), "main"), OperatorError) << later;
    std::filesystem::remove(folder / later);
  }
  EXPECT_EQ(ReadResumedRoom(folder.path(), "main").tick(), 60);
}

/// Whole by its checksums, and no room all the same.
TEST(SnapshotFile, OneThatDoesNotLoadGivesWayToTheOneBefore) {
  Workspace folder;
  KeepArena(folder, 120);
  const std::string path = ListSnapshots(folder.path(), "main")[0].path;
  RoomSnapshot snapshot;
  ASSERT_TRUE(ReadSnapshot(path, &snapshot).ok());
  const Bytes good = snapshot.room;
  bool loads = true;
  for (std::size_t at = 8; loads && at < 400; at += 4) {
    snapshot.room = good;
    for (std::size_t i = 0; i < 4; ++i) snapshot.room[good.size() - at + i] = 0xff;
    SignSavedRoom(&snapshot.room);
    Status status = Status::Ok();
    const std::unique_ptr<const SavedRoom> saved = SavedRoom::Read(snapshot.room, &status);
    loads = saved == nullptr || CanLoad(*saved).ok();
  }
  ASSERT_FALSE(loads);
  ASSERT_TRUE(WriteSnapshot(folder.path(), "main", snapshot).ok());
  const ResumedRoom resumed = ReadResumedRoom(folder.path(), "main");
  EXPECT_EQ(resumed.saved_tick, 60);
  ASSERT_EQ(resumed.notes.size(), 1u);
  EXPECT_NE(resumed.notes[0].find("the one before is used"), std::string::npos);
}

TEST(SnapshotFile, OneOfAnotherTickThanItsNameGivesWayToTheOneBefore) {
  Workspace folder;
  KeepArena(folder, 120);
  const std::vector<SnapshotName> files = ListSnapshots(folder.path(), "main");
  std::filesystem::copy_file(files[1].path, folder / "main-000000009000.snapshot");
  const ResumedRoom resumed = ReadResumedRoom(folder.path(), "main");
  EXPECT_EQ(resumed.saved_tick, 120);
  ASSERT_EQ(resumed.notes.size(), 1u);
  EXPECT_NE(resumed.notes[0].find("is of tick 60, its name says 9000"), std::string::npos)
      << resumed.notes[0];
  EXPECT_FALSE(resumed.new_log);
}

TEST(SnapshotFile, OneOfAnotherSceneThanTheLogGivesWayToTheOneBefore) {
  Workspace folder;
  LoneRoom room(Arena());
  RoomLog log(StateLogOf(folder.path(), "main"), true, nullptr);
  Status status;
  room.StepTo(60);
  const Bytes ours = room.Save();
  Room described = SavedRoom::Read(ours, &status)->room();
  described.session = 5;
  log.Publish("SEAM.main.room", 1, Encode(described));
  LogSeal chain;
  chain.session = 5;
  chain.tick = 60;
  log.EndTick("SEAM.main.chain.0", chain, true);
  ASSERT_TRUE(WriteSnapshot(folder.path(), "main", {60, log.Pin(), ours}).ok());
  LoneRoom other(ParseScene("[[part]]\nname = \"ball\"\ncircle = 0.5\n", "other.toml"));
  other.StepTo(120);
  ASSERT_TRUE(WriteSnapshot(folder.path(), "main", {120, log.Pin(), other.Save()}).ok());
  const ResumedRoom resumed = ReadResumedRoom(folder.path(), "main");
  EXPECT_EQ(resumed.saved_tick, 60);
  ASSERT_EQ(resumed.notes.size(), 1u);
  EXPECT_NE(resumed.notes[0].find("another scene"), std::string::npos) << resumed.notes[0];
}

TEST(SnapshotFile, ALogThatIsGoneOrShorterIsBegunAnew) {
  Workspace folder;
  KeepArena(folder, 60);
  const std::string log = StateLogOf(folder.path(), "main");
  const Bytes bytes = ReadBytes(log);
  WriteBytes(log, Bytes(bytes.begin(), bytes.begin() + 40));
  const ResumedRoom shorter = ReadResumedRoom(folder.path(), "main");
  EXPECT_TRUE(shorter.new_log);
  ASSERT_EQ(shorter.notes.size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_TRUE(std::filesystem::exists(log + ".damaged-1")) << "nothing is thrown away";
  EXPECT_EQ(RoomsIn(folder.path()), std::vector<std::string>{"main"});
  EXPECT_TRUE(ReadResumedRoom(folder.path(), "main").new_log);
}

TEST(SnapshotFile, AnotherKeyOfTheLogIsSaid) {
  Workspace folder;
  Secret key, other;
  other.data()[0] = 1;
  {
    LoneRoom room(Arena());
    RoomLog log(StateLogOf(folder.path(), "main"), true, nullptr, &key);
    LogSeal chain;
    chain.session = 5;
    for (chain.tick = 1; chain.tick <= 70; ++chain.tick) {
      log.EndTick("SEAM.main.chain.0", chain, true);
      if (chain.tick != 60) continue;
      room.StepTo(60);
      ASSERT_TRUE(WriteSnapshot(folder.path(), "main", {60, log.Pin(), room.Save()}).ok());
    }
  }
  EXPECT_TRUE(ReadResumedRoom(folder.path(), "main", &key).notes.empty());
  const ResumedRoom room = ReadResumedRoom(folder.path(), "main", &other);
  ASSERT_EQ(room.notes.size(), 1u);
  EXPECT_NE(room.notes[0].find("not written with this key"), std::string::npos) << room.notes[0];
}

TEST(SnapshotFile, AFolderWithARoomIsNotWrittenOver) {
  Workspace folder;
  KeepArena(folder, 60);
  EXPECT_THROW(PrepareStateFolder(folder.path(), "main", false), OperatorError);
  EXPECT_NO_THROW(PrepareStateFolder(folder.path(), "other", false));
  PrepareStateFolder(folder.path(), "main", true);
  EXPECT_TRUE(ListSnapshots(folder.path(), "main").empty());
  EXPECT_THROW(RoomsIn(folder / "none"), OperatorError);
}

TEST(SnapshotFile, ARoomThatWasKilledBeforeItBeganIsBegunAnew) {
  Workspace folder;
  const std::string log = StateLogOf(folder.path(), "main", 1);
  WriteBytes(log, Bytes(100, 7));
  PrepareStateFolder(folder.path(), "main", false);
  EXPECT_FALSE(std::filesystem::exists(log));
  EXPECT_TRUE(std::filesystem::exists(log + ".damaged-1")) << "nothing is thrown away";
}

TEST(SnapshotFile, ALogOfARoomThatOnlyWaitedIsReplaced) {
  Workspace folder;
  const std::string path = StateLogOf(folder.path(), "main", 1);
  const auto write = [&](std::int64_t tick) {
    RoomLog log(path, true, nullptr);
    LogSeal seal;
    seal.session = 5;
    seal.tick = tick;
    log.EndTick("SEAM.main.chain.0", seal, true);
  };
  write(0);
  PrepareStateFolder(folder.path(), "main", false);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "nothing has happened in it";
  write(1);
  PrepareStateFolder(folder.path(), "main", false);
  EXPECT_TRUE(std::filesystem::exists(path + ".damaged-1"));
}

TEST(SnapshotFile, ALogThatIsWrittenNowIsNobodyElses) {
  Workspace folder;
  const std::string path = StateLogOf(folder.path(), "main", 1);
  {
    RoomLog running(path, false, nullptr);
    EXPECT_THROW(PrepareStateFolder(folder.path(), "main", true), OperatorError);
    EXPECT_TRUE(std::filesystem::exists(path));
    EXPECT_THROW(RoomLog(path, LogPlace(), nullptr), OperatorError);
    EXPECT_THROW(RoomLog(path, true, nullptr), OperatorError);
  }
  EXPECT_NO_THROW(PrepareStateFolder(folder.path(), "main", true));
}

}  // namespace snapshot_file_test
}  // namespace seam
