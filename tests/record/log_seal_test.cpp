/// Seals of a publisher in a log: few, and yet the log ends with one after each tick.

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/base/random.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"
#include "common/record/room_log.h"
#include "common/record/tick_splitter.h"
#include "common/sync/publisher.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace log_seal_test {

/// A server that publishes `events` messages a tick: some before the step, some after it.
class Room {
 public:
  Room(const std::string& path, int events)
      : log(path, true, nullptr), publisher_(log, "r", 77), events_(events) {}
  void Step() {
    for (int i = 0; i < events_ / 2; ++i) Say("before");
    publisher_.NoteStep();
    for (int i = events_ / 2; i < events_; ++i) Say("after");
    ++tick;
    publisher_.NoteTick(0x30000 + static_cast<std::uint64_t>(tick));
    publisher_.EndTick(tick, 0, tick);
  }
  void Say(const std::string& text) {
    Event event;
    event.tick = tick;
    event.text = text + std::string(40, '.');
    publisher_.Publish(event);
  }
  /// Goes on `ticks` ticks later, as a room whose disk was full goes on from a newer snapshot.
  void Skip(std::int64_t ticks) {
    Say("before");
    publisher_.EndTick(tick, 0, tick, true);
    tick += ticks;
  }
  RoomLog log;
  std::int64_t tick = 0;

 private:
  Publisher publisher_;
  int events_;
};

struct Found {
  std::vector<TickMessages> ticks;
  std::vector<DamagedRange> damage;
  std::int64_t bytes = 0, seal_bytes = 0, events = 0;
};

Found ReadAll(const std::string& path) {
  Found found;
  LogReader reader(path);
  TickSplitter splitter;
  for (LogEvent event; reader.Next(&event); ++found.events) {
    const auto bytes =
        static_cast<std::int64_t>(kLogHeaderBytes + event.channel.size() + event.data.size());
    found.bytes += bytes;
    AnyMessage any = Decode(event.data);
    if (const auto* seal = std::get_if<LogSeal>(&any)) {
      found.seal_bytes += bytes;
      for (TickMessages& tick : splitter.End(*seal)) found.ticks.push_back(std::move(tick));
    } else {
      splitter.Add(std::move(any));
    }
  }
  found.damage = reader.damage();
  return found;
}

/// Expects ticks 1 to `last`, each with its own messages.
void ExpectTicks(const Found& found, std::int64_t last, int events) {
  ASSERT_EQ(static_cast<std::int64_t>(found.ticks.size()), last);
  for (std::int64_t i = 0; i < last; ++i) {
    const TickMessages& tick = found.ticks[static_cast<std::size_t>(i)];
    ASSERT_EQ(tick.tick, i + 1);
    EXPECT_EQ(tick.hash, static_cast<std::uint16_t>(i + 1));
    ASSERT_EQ(static_cast<int>(tick.before.size()), events / 2) << i;
    ASSERT_EQ(static_cast<int>(tick.after.size()), events - events / 2) << i;
    for (const AnyMessage& any : tick.before) EXPECT_EQ(std::get<Event>(any).tick, i);
  }
}

TEST(LogSeal, IsLittleBesideTheMessages) {
  for (const int events : {2, 4, 30}) {
    TemporaryFile file;
    Room room(file.path(), events);
    for (int i = 0; i < 300; ++i) room.Step();
    room.log.Flush();
    const Found found = ReadAll(file.path());
    EXPECT_LT(100 * found.seal_bytes, 3 * found.bytes) << events;
    EXPECT_TRUE(found.damage.empty());
    ExpectTicks(found, 300, events);
  }
}

TEST(LogSeal, StandsAtTheEndAfterEachTick) {
  for (const int events : {0, 1, 3}) {
    TemporaryFile file;
    Room room(file.path(), events);
    for (int i = 0; i < 150; ++i) {
      room.Step();
      const Found found = ReadAll(file.path());
      ASSERT_TRUE(found.damage.empty()) << i;
      ExpectTicks(found, room.tick, events);
    }
  }
}

TEST(LogSeal, IsKeptWhereALogMayGoOn) {
  TemporaryFile file;
  Random random(5);
  Room room(file.path(), 3);
  std::vector<std::pair<std::int64_t, LogPlace>> places;
  for (int i = 0; i < 200; ++i) {
    room.Step();
    if (random.Next() % 7 == 0) places.emplace_back(room.tick, room.log.Pin());
  }
  room.log.Flush();
  const Found found = ReadAll(file.path());
  EXPECT_TRUE(found.damage.empty());
  ExpectTicks(found, 200, 3);
  std::int64_t n = 0;
  LogReader numbers(file.path());
  for (LogEvent event; numbers.Next(&event);) EXPECT_EQ(event.number, n++);
  for (const auto& [tick, place] : places) {
    LogReader reader(file.path(), place);
    TickSplitter splitter;
    std::int64_t next = tick;
    for (LogEvent event; reader.Next(&event);) {
      AnyMessage any = Decode(event.data);
      const auto* seal = std::get_if<LogSeal>(&any);
      if (seal == nullptr) {
        splitter.Add(std::move(any));
        continue;
      }
      for (const TickMessages& each : splitter.End(*seal)) {
        ASSERT_EQ(each.tick, ++next);
        ASSERT_EQ(each.before.size() + each.after.size(), 3u);
        EXPECT_EQ(std::get<Event>(each.after.front()).tick, next - 1);
      }
    }
    EXPECT_EQ(next, 200);
    EXPECT_TRUE(reader.damage().empty()) << tick;
  }
}

TEST(LogSeal, TicksThatTheLogLacksAreNamed) {
  TemporaryFile file;
  Room room(file.path(), 3);
  for (int i = 0; i < 100; ++i) room.Step();
  room.Skip(400);
  for (int i = 0; i < 100; ++i) room.Step();
  room.log.Flush();
  const Found found = ReadAll(file.path());
  ASSERT_EQ(found.damage.size(), 1u);
  EXPECT_TRUE(found.damage[0].missing);
  EXPECT_EQ(found.damage[0].first_tick, 101);
  EXPECT_EQ(found.damage[0].last_tick, 500);
  Recording recording;
  recording.damage = found.damage;
  EXPECT_EQ(DamageLines(recording).front(), "ticks 101 to 500 are missing");
}

TEST(LogSeal, OneOfNoTickIsNoTickOfTheRoom) {
  TemporaryFile file;
  Room room(file.path(), 3);
  room.Say("before");  // as a cut's scene and edits, before its part
  room.log.Flush();
  room.tick = 60;
  for (int i = 0; i < 9; ++i) room.Step();
  room.log.Flush();
  EXPECT_TRUE(ReadAll(file.path()).damage.empty());
}

TEST(LogSeal, AnotherPeersTickIsNoTickOfTheRoom) {
  TemporaryFile file;
  Room room(file.path(), 3);
  for (int i = 0; i < 9; ++i) room.Step();
  LogSeal late;
  late.session = 77;
  late.peer = 1;
  late.tick = 5;
  room.log.EndTick("SEAM.r.chain.1", late, true);
  room.Say("before");
  room.log.Flush();
  for (int i = 0; i < 9; ++i) room.Step();
  room.log.Flush();
  EXPECT_TRUE(ReadAll(file.path()).damage.empty());
}

TEST(LogSeal, EveryFlippedBitIsReportedWithItsTicks) {
  TemporaryFile file;
  std::vector<std::int64_t> ends;
  {
    Room room(file.path(), 3);
    for (int i = 0; i < 100; ++i) {
      room.Step();
      ends.push_back(static_cast<std::int64_t>(file.Read().size()));
    }
  }
  const Bytes good = file.Read();
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    Bytes bad = good;
    const std::size_t at = random.Next() % bad.size();
    bad[at] ^= static_cast<std::uint8_t>(1u << random.Next() % 8);
    file.Write(bad);
    const std::vector<DamagedRange> damage = ReadAll(file.path()).damage;
    ASSERT_EQ(damage.size(), 1u) << "byte " << at;
    // An event of a tick lies before the seal that stood behind it, which the next one replaced.
    const auto tick =
        std::upper_bound(ends.begin(), ends.end(), static_cast<std::int64_t>(at)) - ends.begin();
    EXPECT_LE(damage[0].first_tick, tick + 2) << "byte " << at;
    EXPECT_TRUE(damage[0].to_the_end || damage[0].last_tick >= tick) << "byte " << at;
    EXPECT_LE(damage[0].last_tick - damage[0].first_tick, 2 * kSealTicksMax) << "byte " << at;
  }
}

TEST(LogSeal, TicksArePackedAndMalformedOnesRefused) {
  LogSeal seal;
  seal.tick = 100;
  const std::vector<SealedTick> ticks = {
      {98, 0, 1, 3}, {99, 127, 128, 0xffff}, {100, INT32_MAX, 0, 7}};
  seal.ticks = PackTicks(ticks);
  const std::optional<std::vector<SealedTick>> back = TicksOf(seal);
  ASSERT_TRUE(back && back->size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ((*back)[i].tick, ticks[i].tick);
    EXPECT_EQ((*back)[i].before, ticks[i].before);
    EXPECT_EQ((*back)[i].after, ticks[i].after);
    EXPECT_EQ((*back)[i].hash, ticks[i].hash);
  }
  seal.ticks.pop_back();
  EXPECT_FALSE(TicksOf(seal));
  seal.ticks.assign(4 * (kSealTicksMax + 1), 0);
  EXPECT_FALSE(TicksOf(seal));
  seal.ticks = {0xff, 0xff, 0xff, 0xff, 0xff, 0, 0, 0};
  EXPECT_FALSE(TicksOf(seal));
}

}  // namespace log_seal_test
}  // namespace seam
