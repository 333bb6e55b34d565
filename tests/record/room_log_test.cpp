/// Logs with checksums: damage is found, wherever it is.

#include "common/record/room_log.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>

#include "common/base/check.h"
#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/record/damage.h"
#include "common/record/disk_thread.h"
#include "common/record/log_file.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace room_log_test {

constexpr std::int64_t kSession = 77;

Bytes EventOf(int peer, std::int64_t sequence, const std::string& text) {
  Event event;
  event.utime = 1000 + sequence;
  event.session = kSession;
  event.sequence = sequence;
  event.peer = peer;
  event.text = text;
  return Encode(event);
}

/// Ends a tick as a Publisher does: with a checksum of what it published, if `messages` says so.
void EndTick(RoomLog* log, std::int64_t tick, std::int32_t messages, std::int32_t crc) {
  LogSeal chain;
  chain.utime = 1000000 + tick;
  chain.session = kSession;
  chain.sequence = static_cast<std::int32_t>(tick);
  chain.tick = tick;
  chain.messages = messages;
  chain.messages_crc = crc;
  log->EndTick(ChannelName("r", "chain", 0), chain, true);
}

/// Ticks of two events of the server and one of a client.
void WriteTicks(RoomLog* log, std::int64_t from, std::int64_t to) {
  for (std::int64_t tick = from; tick < to; ++tick) {
    std::int32_t crc = 0;
    for (const std::int64_t i : {0, 1}) {
      const std::string channel = ChannelName("r", "event", 0);
      const Bytes event = EventOf(0, 2 * tick + i, "tick " + std::to_string(tick));
      crc = ChainedCrc(crc, channel, event);
      log->Publish(channel, tick, event);
    }
    log->Publish(ChannelName("r", "event", 1), tick, EventOf(1, tick, "other"));
    EndTick(log, tick, 2, crc);
  }
}

struct Found {
  std::vector<LogEvent> events;
  std::vector<DamagedRange> damage;
  std::int64_t skipped_bytes = 0;
};

Found ReadAll(const std::string& path) {
  Found found;
  LogReader reader(path);
  for (LogEvent event; reader.Next(&event);) found.events.push_back(event);
  found.damage = reader.damage();
  found.skipped_bytes = reader.skipped_bytes();
  return found;
}

TEST(RoomLog, EachTickEndsWithItsChecksum) {
  TemporaryFile file;
  {
    DiskThread disk;
    RoomLog log(file.path(), false, &disk);
    WriteTicks(&log, 0, 30);
    EXPECT_EQ(log.Pin().number, 30 * 4);
    EXPECT_EQ(static_cast<std::size_t>(log.Pin().bytes), file.Read().size()) << "written at once";
    log.Publish(ChannelName("r", "event", 1), 5, EventOf(1, 30, "after the last tick"));
  }
  const Found found = ReadAll(file.path());
  EXPECT_EQ(found.events.size(), 30u * 4 + 2) << "the rest has a chain of its own";
  EXPECT_TRUE(found.damage.empty());
  EXPECT_EQ(found.skipped_bytes, 0);
}

TEST(RoomLog, EveryFlippedBitIsReportedWithItsTick) {
  TemporaryFile file;
  std::vector<std::int64_t> ends;
  {
    RoomLog log(file.path(), false, nullptr);
    for (std::int64_t tick = 0; tick < 40; ++tick) {
      WriteTicks(&log, tick, tick + 1);
      ends.push_back(log.Pin().bytes);
    }
  }
  const Bytes good = file.Read();
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    Bytes bad = good;
    const std::size_t at = random.Next() % bad.size();
    bad[at] ^= static_cast<std::uint8_t>(1u << random.Next() % 8);
    file.Write(bad);
    const Found found = ReadAll(file.path());
    ASSERT_EQ(found.damage.size(), 1u) << "byte " << at;
    const auto tick =
        std::upper_bound(ends.begin(), ends.end(), static_cast<std::int64_t>(at)) - ends.begin();
    const DamagedRange& part = found.damage.front();
    EXPECT_LE(part.first_tick, tick) << "byte " << at;
    EXPECT_GE(part.last_tick, tick) << "byte " << at;
    EXPECT_LE(part.last_tick - part.first_tick, 2) << "byte " << at;
    if (found.skipped_bytes == 0) {
      EXPECT_FALSE(part.channels.empty());
    }
  }
}

TEST(RoomLog, CutOffOrShortenedItSaysSo) {
  TemporaryFile file;
  {
    RoomLog log(file.path(), false, nullptr);
    WriteTicks(&log, 0, 20);
  }
  const Bytes good = file.Read();
  const std::size_t tick = good.size() / 20;
  file.Write(Bytes(good.begin(), good.end() - 30));
  ASSERT_EQ(ReadAll(file.path()).damage.size(), 1u);
  EXPECT_TRUE(ReadAll(file.path()).damage.front().to_the_end);
  // Whole ticks that are missing in between: each event of the rest is good.
  Bytes gap(good.begin(), good.begin() + static_cast<long>(5 * tick));
  gap.insert(gap.end(), good.begin() + static_cast<long>(8 * tick), good.end());
  file.Write(gap);
  EXPECT_FALSE(ReadAll(file.path()).damage.empty());
}

TEST(RoomLog, TwoLogsInOneFileAreWhole) {
  TemporaryFile one, two;
  for (const TemporaryFile* file : {&one, &two}) {
    RoomLog log(file->path(), false, nullptr);
    WriteTicks(&log, 0, 10);
  }
  Bytes both = one.Read();
  const Bytes more = two.Read();
  both.insert(both.end(), more.begin(), more.end());
  one.Write(both);
  EXPECT_TRUE(ReadAll(one.path()).damage.empty());
}

TEST(RoomLog, GoesOnWhereATickWasCutOff) {
  TemporaryFile file;
  LogPlace place;
  {
    RoomLog log(file.path(), false, nullptr);
    WriteTicks(&log, 0, 10);
    place = log.Pin();
    WriteTicks(&log, 10, 11);
  }
  Bytes cut = file.Read();
  cut.resize(cut.size() - 50);
  file.Write(cut);
  {
    RoomLog log(file.path(), place, nullptr);
    EXPECT_THROW(RoomLog(file.path(), place, nullptr), OperatorError) << "one writer at a time";
    WriteTicks(&log, 10, 20);
  }
  const Found found = ReadAll(file.path());
  EXPECT_TRUE(found.damage.empty());
  ASSERT_EQ(found.events.size(), 20u * 4);
  for (std::size_t i = 0; i < found.events.size(); ++i) {
    EXPECT_EQ(found.events[i].number, static_cast<std::int64_t>(i));
  }
}

TEST(RoomLog, AFullDiskLeavesWholeTicks) {
  TemporaryFile file;
  RoomLog log(file.path(), false, nullptr);
  WriteTicks(&log, 0, 5);
  const LogPlace place = log.Pin();
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit little = before;
  little.rlim_cur = static_cast<rlim_t>(place.bytes) + 100;  // a part of the next tick fits
  setrlimit(RLIMIT_FSIZE, &little);
  WriteTicks(&log, 5, 7);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  WriteTicks(&log, 7, 9);  // there is room again, but the log would have a hole
  EXPECT_EQ(log.trouble().why(), file.path() + ": cannot be written: File too large");
  EXPECT_EQ(log.failures(), 4 * 4);
  EXPECT_EQ(static_cast<std::int64_t>(file.Read().size()), place.bytes);
  const Found found = ReadAll(file.path());
  EXPECT_TRUE(found.damage.empty());
  EXPECT_EQ(found.skipped_bytes, 0);
}

/// Writes the log as a stock logger would have heard it: with other numbers and times, without the
/// events that `lost` names, and with the rooms that a server repeats.
void Capture(const std::string& from, const std::string& to, const std::string& lost,
             std::int64_t flip_event) {
  LogReader reader(from);
  LogWriter writer(to, true);
  std::int64_t n = 0;
  for (LogEvent event; reader.Next(&event); ++n) {
    if (!lost.empty() && event.channel == lost && n % 7 == 0) continue;
    if (n == flip_event) event.data[40] ^= 4;
    writer.Publish(event.channel, 5000000 + n, event.data);
    Room again;
    again.session = SessionOf(event.data).value_or(0);
    again.sequence = kSaidAgain;
    if (n % 5 == 0 && again.session != 0) {
      writer.Publish("SEAM.r.scene", 5000000 + n, Encode(again));
    }
  }
}

TEST(RoomLog, ACaptureOfAnotherLoggerIsCheckedByThePublishersMessages) {
  TemporaryFile file, captured;
  {
    RoomLog log(file.path(), false, nullptr);
    WriteTicks(&log, 0, 20);
  }
  Capture(file.path(), captured.path(), "", -1);
  EXPECT_TRUE(ReadAll(captured.path()).damage.empty());
  Capture(file.path(), captured.path(), "", 4 * 8 + 1);
  const Found found = ReadAll(captured.path());
  ASSERT_EQ(found.damage.size(), 1u);
  EXPECT_EQ(found.damage[0].first_tick, 8);
  EXPECT_EQ(found.damage[0].last_tick, 8);
  EXPECT_EQ(found.damage[0].channels, (std::set<std::string>{"SEAM.r.event.0"}));
  // What a logger has not heard is a gap, and no damage.
  Capture(file.path(), captured.path(), "SEAM.r.event.0", -1);
  EXPECT_TRUE(ReadAll(captured.path()).damage.empty());
}

TEST(RoomLog, ChannelsBelongToTheirPublisher) {
  EXPECT_EQ(PublisherOfChannel("SEAM.r.view.3"), 3);
  EXPECT_EQ(PublisherOfChannel("SEAM.r.event.12"), 12);
  EXPECT_EQ(PublisherOfChannel("SEAM.r.states.3"), 0) << "the server publishes what it accepted";
  EXPECT_EQ(PublisherOfChannel("SEAM.r.inputs.1"), 0);
  EXPECT_EQ(PublisherOfChannel("SEAM.r.scene"), 0);
  EXPECT_EQ(PublisherOfChannel("OTHER"), -1);
}

}  // namespace room_log_test
}  // namespace seam
