/// The log of a kept room in segments: gone on with when one is damaged, and removed when old.

#include "server/saved/old_segments.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/chain_check.h"
#include "common/record/log_file.h"
#include "server/saved/resumed_room.h"
#include "server/saved/snapshot_file.h"
#include "tests/support/arena.h"
#include "tests/support/lone_room.h"
#include "tests/support/program.h"

namespace seam {
namespace old_segments_test {

namespace fs = std::filesystem;

constexpr std::int64_t kDayS = 86400, kSegment = 2000;

/// Ends a tick that has one message.
void WriteTick(RoomLog* log, std::int64_t tick) {
  const std::string channel = ChannelName("main", "event", 0);
  Event event;
  event.session = 5;
  event.sequence = event.tick = tick;
  const Bytes message = Encode(event);
  log->Publish(channel, tick, message);
  LogSeal seal;
  seal.utime = tick;
  seal.session = 5;
  seal.sequence = static_cast<std::int32_t>(tick);
  seal.tick = tick;
  seal.messages = 1;
  seal.messages_crc = ChainedCrc(0, channel, message);
  seal.ticks = PackTicks({{tick, 0, 1, 0}});
  log->EndTick(ChannelName("main", "chain", 0), seal, true);
}

/// A room that was kept for 210 ticks, with snapshots of ticks 120 and 180.
class OldSegments : public ::testing::Test {
 protected:
  OldSegments() {
    LoneRoom room(Arena());
    RoomLog log(Log(), true, nullptr, nullptr, kSegment);
    for (std::int64_t tick = 1; tick <= 210; ++tick) {
      WriteTick(&log, tick);
      places_.push_back(log.Pin());
      if (tick % 60 != 0 || tick < 120 || tick > 180) continue;
      room.StepTo(tick);
      EXPECT_TRUE(WriteSnapshot(folder_.path(), "main", {tick, log.Pin(), room.Save()}).ok());
    }
  }
  std::string Log() const { return StateLogOf(folder_.path(), "main"); }
  std::int32_t SegmentOf(std::int64_t tick) const {
    return places_[static_cast<std::size_t>(tick - 1)].segment;
  }
  std::vector<std::int32_t> Numbers() const {
    std::vector<std::int32_t> numbers;
    for (const LogSegment& segment : ListSegments(Log())) numbers.push_back(segment.number);
    return numbers;
  }
  /// Makes segments as old as this.
  void Age(std::int32_t up_to, std::int64_t days) const {
    const auto then = fs::file_time_type::clock::now() - std::chrono::hours(24 * days);
    for (const LogSegment& segment : ListSegments(Log())) {
      if (segment.number <= up_to) fs::last_write_time(segment.path, then);
    }
  }
  std::string Remove() const { return RemoveOldSegments(folder_.path(), "main", 1, 7 * kDayS); }
  std::int64_t LastTick(const ResumedRoom& room) const {
    return room.tail.ticks.empty() ? room.saved_tick : room.tail.ticks.back().tick;
  }

  Workspace folder_;
  std::vector<LogPlace> places_;  // ends of the ticks
};

TEST_F(OldSegments, AreRemovedUpToTheOlderSnapshot) {
  const std::int32_t first = SegmentOf(120);
  ASSERT_GE(first, 3);
  ASSERT_GT(SegmentOf(180), first);
  EXPECT_EQ(Remove(), "") << "all are young";
  Age(SegmentOf(210), 8);
  EXPECT_EQ(Remove(), "removed " + std::to_string(first) + " segment(s) of its log, up to " +
                          fs::path(SegmentPath(Log(), first - 1)).filename().string() +
                          " (--keep)");
  EXPECT_EQ(Numbers().front(), first);
  EXPECT_EQ(Numbers().back(), SegmentOf(210));
  EXPECT_EQ(Remove(), "");
  // What is left is the room: from either snapshot.
  EXPECT_EQ(LastTick(ReadResumedRoom(folder_.path(), "main")), 210);
  fs::remove(ListSnapshots(folder_.path(), "main")[0].path);
  const ResumedRoom room = ReadResumedRoom(folder_.path(), "main");
  EXPECT_EQ(room.saved_tick, 120);
  EXPECT_EQ(LastTick(room), 210);
  EXPECT_TRUE(room.notes.empty());
  // And the numbers go on.
  RoomLog log(room.log, room.tail.end, nullptr, nullptr, kSegment);
  for (std::int64_t tick = 211; tick < 260; ++tick) WriteTick(&log, tick);
  EXPECT_GT(log.Pin().segment, SegmentOf(210));
  LogReader reader(folder_.path());
  for (LogEvent event; reader.Next(&event);) continue;
  EXPECT_TRUE(reader.damage().empty());
}

TEST_F(OldSegments, YoungOnesStay) {
  Age(1, 8);
  EXPECT_NE(Remove(), "");
  EXPECT_EQ(Numbers().front(), 2);
}

TEST_F(OldSegments, AllStayWhileASnapshotCannotBeRead) {
  Age(SegmentOf(210), 8);
  std::fstream file(ListSnapshots(folder_.path(), "main")[1].path,
                    std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(300);
  file.put('!').put('?');
  file.close();
  EXPECT_EQ(Remove(), "");
  EXPECT_EQ(Numbers().front(), 0);
}

TEST_F(OldSegments, TheLastOneStaysWithoutASnapshot) {
  for (const SnapshotName& file : ListSnapshots(folder_.path(), "main")) fs::remove(file.path);
  Age(SegmentOf(210), 8);
  EXPECT_NE(Remove(), "");
  EXPECT_EQ(Numbers(), (std::vector<std::int32_t>{SegmentOf(210)}));
}

TEST_F(OldSegments, TheTimeIsSaidWithItsUnit) {
  EXPECT_EQ(ParseKeep("7d"), 7 * kDayS);
  EXPECT_EQ(ParseKeep("1.5h"), 5400);
  EXPECT_EQ(ParseKeep("30m"), 1800);
  for (const char* bad : {"", "7", "d", "-7d", "0d", "7s", "7 days", "nand", "inf d", "1e99d"}) {
    EXPECT_THROW(ParseKeep(bad), OperatorError) << bad;
  }
}

TEST_F(OldSegments, BehindAMissingOneAreKeptUnderAnotherName) {
  const std::int32_t missing = SegmentOf(180) + 1;
  ASSERT_LT(missing, SegmentOf(210));
  const std::string after = SegmentPath(Log(), missing + 1);
  fs::remove(SegmentPath(Log(), missing));
  const ResumedRoom room = ReadResumedRoom(folder_.path(), "main");
  EXPECT_EQ(room.tail.end.segment, missing - 1);
  EXPECT_EQ(SegmentOf(LastTick(room)), missing - 1);
  EXPECT_EQ(SegmentOf(LastTick(room) + 1), missing);
  EXPECT_FALSE(room.new_log);
  ASSERT_EQ(room.notes.size(), 1u);
  EXPECT_EQ(room.notes[0].find(after + ": is damaged after tick "), 0u) << room.notes[0];
  EXPECT_TRUE(fs::exists(after + ".damaged-1"));
  EXPECT_EQ(Numbers().back(), missing - 1);
}

TEST_F(OldSegments, AnotherFileInThePlaceOfTheNextIsKeptUnderAnotherName) {
  const std::string next = SegmentPath(Log(), SegmentOf(210) + 1);
  std::ofstream(next) << "somebody's only copy";
  std::ofstream(SegmentPath(Log(), SegmentOf(210) + 2)) << "";  // a segment that was not begun
  const ResumedRoom room = ReadResumedRoom(folder_.path(), "main");
  EXPECT_EQ(LastTick(room), 210);
  EXPECT_FALSE(room.new_log);
  ASSERT_EQ(room.notes.size(), 1u);
  EXPECT_EQ(room.notes[0].find(next + ": "), 0u) << room.notes[0];
  RoomLog log(room.log, room.tail.end, nullptr, nullptr, kSegment);
  std::string kept;
  std::getline(std::ifstream(next + ".damaged-1"), kept);
  EXPECT_EQ(kept, "somebody's only copy");
  EXPECT_EQ(Numbers().back(), SegmentOf(210));
}

TEST_F(OldSegments, AFolderOrADanglingLinkInThatPlaceIsPutAsideToo) {
  const std::string next = SegmentPath(Log(), SegmentOf(210) + 1);
  fs::create_directory(next);
  EXPECT_EQ(ReadResumedRoom(folder_.path(), "main").notes.size(), 1u);
  EXPECT_TRUE(fs::is_directory(next + ".damaged-1"));
  fs::create_symlink("nowhere", next);
  EXPECT_EQ(ReadResumedRoom(folder_.path(), "main").notes.size(), 1u);
  EXPECT_TRUE(fs::is_symlink(next + ".damaged-2"));
}

TEST_F(OldSegments, ADamagedOneIsReplacedByANewOne) {
  const std::int32_t damaged = SegmentOf(180);
  const std::string path = SegmentPath(Log(), damaged);
  const std::int64_t last = 182;
  ASSERT_EQ(SegmentOf(last), damaged);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(places_[last - 1].bytes + 60);
  file.put('!').put('?');
  file.close();
  const ResumedRoom room = ReadResumedRoom(folder_.path(), "main");
  EXPECT_EQ(LastTick(room), last);
  EXPECT_TRUE(room.new_log);
  EXPECT_TRUE(fs::exists(path + ".damaged-1"));
  EXPECT_EQ(Numbers().back(), damaged - 1);
  {
    RoomLog log(room.log, room.tail.end, nullptr, nullptr, kSegment);
    for (std::int64_t tick = last + 1; tick < 260; ++tick) WriteTick(&log, tick);
  }
  EXPECT_GT(Numbers().back(), damaged);
  LogReader reader(folder_.path());
  for (LogEvent event; reader.Next(&event);) continue;
  const std::vector<DamagedRange> damage = reader.damage();
  ASSERT_EQ(damage.size(), 1u) << "the ticks that are in the old file only";
  EXPECT_EQ(SegmentOf(damage[0].first_tick), damaged);
  EXPECT_EQ(damage[0].last_tick, last);
}

}  // namespace old_segments_test
}  // namespace seam
