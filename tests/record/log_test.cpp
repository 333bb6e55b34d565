#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "tests/support/allocations/count_allocations.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace log_test {

std::vector<LogEvent> RandomEvents(std::uint64_t seed, int count, std::size_t bytes_max) {
  Random random(seed);
  std::vector<LogEvent> events;
  for (int i = 0; i < count; ++i) {
    LogEvent event;
    event.number = i;
    event.timestamp_us = static_cast<std::int64_t>(random.Next() >> 12);
    event.channel = "SEAM.r.view." + std::to_string(random.Next() % 32);
    event.data.resize(random.Next() % (bytes_max + 1));
    for (std::uint8_t& byte : event.data) byte = static_cast<std::uint8_t>(random.Next());
    events.push_back(event);
  }
  return events;
}

Bytes WriteLog(const std::vector<LogEvent>& events) {
  TemporaryFile file;
  {
    LogWriter writer(file.path());
    for (const LogEvent& e : events) writer.Publish(e.channel, e.timestamp_us, e.data);
    EXPECT_EQ(writer.failures(), 0);
  }
  return file.Read();
}

struct ReadBack {
  std::vector<LogEvent> events;
  std::int64_t skipped_bytes = 0, damaged_places = 0;
  bool opened = true;
};

ReadBack ReadLog(const Bytes& bytes) {
  const int fd = memfd_create("log", 0);  // no disk: some tests read tens of thousands of logs
  EXPECT_EQ(write(fd, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  ReadBack back;
  try {
    LogReader reader("/proc/self/fd/" + std::to_string(fd));
    LogEvent event;
    while (reader.Next(&event)) back.events.push_back(event);
    EXPECT_FALSE(reader.Next(&event)) << "the end stays the end";
    back.skipped_bytes = reader.skipped_bytes();
    back.damaged_places = reader.damaged_places();
  } catch (const OperatorError&) {
    back.opened = false;
  }
  close(fd);
  // Every byte of the file is either in an event or counted as skipped.
  std::int64_t accounted = back.skipped_bytes;
  for (const LogEvent& e : back.events) {
    accounted += static_cast<std::int64_t>(kLogHeaderBytes + e.channel.size() + e.data.size());
  }
  if (back.opened) {
    EXPECT_EQ(accounted, static_cast<std::int64_t>(bytes.size()));
  }
  return back;
}

std::size_t EventBytes(const LogEvent& e) {
  return kLogHeaderBytes + e.channel.size() + e.data.size();
}

TEST(Log, ReadsBackAWrittenLog) {
  const std::vector<LogEvent> events = RandomEvents(1, 300, 60000);
  const ReadBack back = ReadLog(WriteLog(events));
  EXPECT_TRUE(back.events == events);
  EXPECT_EQ(back.skipped_bytes, 0);
  EXPECT_EQ(back.damaged_places, 0);
}

TEST(Log, BytesDependOnTheArgumentsAlone) {
  const std::vector<LogEvent> events = RandomEvents(2, 20, 100);
  EXPECT_EQ(WriteLog(events), WriteLog(events));
  const LogEvent one = {0, 0x0102030405060708, "AB", {0xff}};
  const Bytes expected = {0xed, 0xa1, 0xda, 0x01, 0, 0, 0, 0, 0, 0, 0, 0, 1,   2,   3,   4,
                          5,    6,    7,    8,    0, 0, 0, 2, 0, 0, 0, 1, 'A', 'B', 0xff};
  EXPECT_EQ(WriteLog({one}), expected);
}

TEST(Log, WritesTheExampleOfTheDocumentation) {
  Event event;
  event.utime = 5;
  event.session = 0x1122334455667788;
  event.sequence = 1;
  event.peer = 2;
  event.tick = 3;
  event.text = "hi";
  const Bytes log = WriteLog({{0, 5, ChannelName("r", "event", 2), Encode(event)}});
  std::string hex;
  for (const std::uint8_t byte : log) {
    for (const int digit : {byte >> 4, byte & 15}) hex += "0123456789abcdef"[digit];
  }
  // docs/recordings.md, "The file": change both or neither.
  EXPECT_EQ(hex,
            "eda1da010000000000000000"
            "0000000000000005"
            "0000000e00000050"
            "5345414d2e722e6576656e742e32"
            "08d79625822525c8"
            "0000000000000005"
            "1122334455667788"
            "000000000000000100000002"
            "0000000000000003"
            "0000000368690000"
            "ffffffffffffffffffffffffffffffffffffffff"
            "0000000000000000");
}

TEST(Log, RefusesToOverwriteUnlessForced) {
  TemporaryFile file;
  file.Write({1, 2, 3});
  EXPECT_THROW(LogWriter(file.path()), OperatorError);
  EXPECT_EQ(file.Read(), (Bytes{1, 2, 3}));
  { LogWriter forced(file.path(), true); }
  EXPECT_EQ(file.Read(), Bytes{});
  EXPECT_THROW(LogWriter("/nonexistent/folder/a.lcm"), OperatorError);
}

TEST(Log, CountsEventsThatItCannotWrite) {
  TemporaryFile file;
  LogWriter writer(file.path());
  writer.Publish("", 0, Bytes{1});
  writer.Publish(std::string(64, 'A'), 0, Bytes{1});
  writer.Publish("BIG", 0, Bytes(kLogDataBytesMax + 1));
  EXPECT_EQ(writer.failures(), 3);
  writer.Flush();
  EXPECT_EQ(file.Read(), Bytes{});
}

TEST(Log, CountsEventsLostToAFullDisk) {
  TemporaryFile file;
  LogWriter full(file.path());
  EXPECT_TRUE(full.trouble().ok());
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit little = before;
  little.rlim_cur = 10;
  setrlimit(RLIMIT_FSIZE, &little);
  full.Publish("A", 0, Bytes{1});
  full.Flush();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(full.failures(), 1);
  EXPECT_EQ(full.trouble().why(), file.path() + ": cannot be written: File too large");
}

TEST(Log, WritesAndReadsRegularFilesOnly) {
  for (const bool force : {false, true}) {
    EXPECT_THROW(LogWriter("/dev/full", force), OperatorError);
    EXPECT_THROW(LogWriter("/tmp", force), OperatorError);
  }
  TemporaryFile file;
  ASSERT_EQ(mkfifo(file.path().c_str(), 0600), 0);
  EXPECT_THROW(LogWriter(file.path(), true), OperatorError);
  EXPECT_THROW(LogWriter::Check(file.path(), true), OperatorError);
  EXPECT_THROW(LogReader(file.path()), OperatorError);
}

TEST(Log, AFileThatIsNoLogIsAnOperatorsMistake) {
  EXPECT_THROW(LogReader("/nonexistent.lcm"), OperatorError);
  EXPECT_THROW(LogReader("/tmp"), OperatorError);
  EXPECT_THROW(LogReader("/dev/zero"), OperatorError);
  EXPECT_FALSE(ReadLog({}).opened);
  EXPECT_FALSE(ReadLog(Bytes(1000, 0xed)).opened);
}

TEST(Log, TruncatedAnywhereKeepsEveryWholeEvent) {
  const std::vector<LogEvent> events = RandomEvents(3, 6, 60);
  const Bytes log = WriteLog(events);
  for (std::size_t size = 0; size < log.size(); ++size) {
    const ReadBack back = ReadLog(Bytes(log.begin(), log.begin() + static_cast<long>(size)));
    std::size_t whole = 0, bytes = 0;
    while (bytes + EventBytes(events[whole]) <= size) bytes += EventBytes(events[whole++]);
    EXPECT_EQ(back.opened, whole > 0) << size;
    ASSERT_EQ(back.events.size(), whole) << size;
    EXPECT_TRUE(std::equal(back.events.begin(), back.events.end(), events.begin())) << size;
    EXPECT_EQ(back.damaged_places, whole > 0 && bytes < size ? 1 : 0) << size;
  }
}

/// True when `kept` contains all of `events` but number `damaged`, in order.
bool KeepsTheOthers(const std::vector<LogEvent>& kept, const std::vector<LogEvent>& events,
                    std::size_t damaged) {
  std::size_t next = 0;
  for (const LogEvent& e : kept) {
    if (next == damaged) ++next;
    if (next < events.size() && e == events[next]) ++next;
  }
  return next == events.size() || (next == damaged && damaged + 1 == events.size());
}

TEST(Log, OneCorruptByteCostsAtMostItsOwnEvent) {
  const std::vector<LogEvent> events = RandomEvents(4, 3, 12);
  Bytes log = WriteLog(events);
  std::size_t event = 0, event_at = 0;
  for (std::size_t at = 0; at < log.size(); ++at) {
    if (at == event_at + EventBytes(events[event])) event_at += EventBytes(events[event++]);
    const std::uint8_t good = log[at];
    for (int value = 0; value < 256; ++value) {
      log[at] = static_cast<std::uint8_t>(value);
      const ReadBack back = ReadLog(log);
      ASSERT_TRUE(back.opened);
      ASSERT_TRUE(KeepsTheOthers(back.events, events, event)) << "byte " << at << " = " << value;
      ASSERT_LE(back.events.size(), events.size());
      const std::size_t field = at - event_at;
      const bool lengths_or_magic = field < 4 || (field >= 20 && field < kLogHeaderBytes);
      if (lengths_or_magic && log[at] != good) {
        ASSERT_GE(back.damaged_places, 1) << at;
      }
    }
    log[at] = good;
  }
}

TEST(Log, RandomBytesBetweenEventsAreSkippedAndCounted) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    const std::vector<LogEvent> events = RandomEvents(random.Next(), 5, 2000);
    Bytes log;
    int places = 0;
    std::int64_t junk_bytes = 0;
    for (const LogEvent& e : events) {
      if (random.Chance(0.5)) {
        Bytes junk(1 + random.Next() % 5000);
        for (std::uint8_t& byte : junk) byte = static_cast<std::uint8_t>(random.Next());
        log.insert(log.end(), junk.begin(), junk.end());
        junk_bytes += static_cast<std::int64_t>(junk.size());
        ++places;
      }
      Bytes bytes = WriteLog({e});
      bytes[11] = static_cast<std::uint8_t>(e.number);
      log.insert(log.end(), bytes.begin(), bytes.end());
    }
    const ReadBack back = ReadLog(log);
    EXPECT_TRUE(back.events == events) << round;
    EXPECT_EQ(back.skipped_bytes, junk_bytes) << round;
    EXPECT_EQ(back.damaged_places, places) << round;
  }
}

TEST(Log, HostileLengthsCostNeitherMemoryNorTheEventsBehind) {
  const std::vector<LogEvent> events = RandomEvents(6, 3, 50);
  const Bytes good = WriteLog(events);
  for (const std::uint32_t length : {0u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 1000001u, 64u}) {
    for (const std::size_t field : {20u, 24u}) {
      Bytes log = good;
      for (std::size_t i = 0; i < 4; ++i) {
        log[field + i] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
      }
      const std::size_t before = AllocatedBytes();
      const ReadBack back = ReadLog(log);
      EXPECT_LE(AllocatedBytes() - before, 2000000u) << length;
      EXPECT_TRUE(KeepsTheOthers(back.events, events, 0)) << length << " at " << field;
    }
  }
}

TEST(Log, ManyNestedFalseHeadersAreReadInLinearWork) {
  // Each header claims the next megabyte, and nothing follows where it ends: the worst case.
  Bytes log;
  for (int i = 0; i < 60000; ++i) {
    const Bytes header = {0xed, 0xa1, 0xda, 0x01, 0, 0, 0, 0, 0, 0, 0,    0,    0,    0,  0,
                          0,    0,    0,    0,    0, 0, 0, 0, 1, 0, 0x0e, 0x00, 0x00, 'A'};
    log.insert(log.end(), header.begin(), header.end());
  }
  const std::size_t before = AllocatedBytes();
  const ReadBack back = ReadLog(log);
  EXPECT_TRUE(back.opened);
  EXPECT_LE(AllocatedBytes() - before, 64u * log.size());
}

}  // namespace log_test
}  // namespace seam
