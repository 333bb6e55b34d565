/// Logs that are written with a key: nobody else can change them, however right their checksums.

#include <gtest/gtest.h>

#include <functional>

#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/net/crc32c.h"
#include "common/record/log_bytes.h"
#include "common/record/log_file.h"
#include "common/record/room_log.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace keyed_log_test {

using Events = std::vector<LogEvent>;

Secret KeyOf(std::uint64_t seed) {
  SeededEntropy entropy(seed);
  return Secret(entropy);
}

void WriteTicks(RoomLog* log, std::int64_t from, std::int64_t to, const std::string& text) {
  for (std::int64_t tick = from; tick < to; ++tick) {
    Event event;
    event.utime = 1000 * tick;
    event.session = 77;
    event.sequence = tick;
    event.text = text + " " + std::to_string(tick);
    log->Publish(ChannelName("r", "event", 0), event.utime, Encode(event));
    LogSeal seal;
    seal.utime = event.utime;
    seal.session = 77;
    seal.sequence = static_cast<std::int32_t>(tick);
    seal.tick = tick;
    seal.messages = -1;
    log->EndTick(ChannelName("r", "chain", 0), seal, tick % 4 == 3);
  }
}

Events Read(const std::string& path) {
  Events events;
  LogReader reader(path);
  for (LogEvent event; reader.Next(&event);) events.push_back(event);
  return events;
}

/// Writes events as somebody would who wants all checksums that need no key to be right.
void WriteAsForger(const TemporaryFile& file, Events events) {
  Bytes all;
  std::uint32_t crc = 0;
  std::int32_t count = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    LogEvent& event = events[i];
    AnyMessage message = Decode(event.data);
    auto* seal = std::get_if<LogSeal>(&message);
    Bytes bytes;
    ++count;
    if (seal != nullptr) {
      seal->log_events = count;
      event.data = Encode(*seal);
      count = 0;
    }
    AppendEvent(&bytes, static_cast<std::int64_t>(i), event.timestamp_us, event.channel,
                event.data);
    crc = Crc32c({bytes.data(), bytes.size() - (seal != nullptr ? 4u : 0u)}, crc);
    for (std::size_t b = 0; seal != nullptr && b < 4; ++b) {
      bytes[bytes.size() - 4 + b] = static_cast<std::uint8_t>(crc >> (24 - 8 * b));
    }
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  file.Write(all);
}

std::vector<DamagedRange> DamageOf(const std::string& path, const Secret* key) {
  LogReader reader(path, key);
  for (LogEvent event; reader.Next(&event);) continue;
  return reader.damage();
}

class KeyedLog : public ::testing::Test {
 protected:
  KeyedLog() : key_(KeyOf(1)) {
    RoomLog log(file_.path(), true, nullptr, &key_);
    WriteTicks(&log, 0, 40, "tick");
  }

  /// Expects that the forged events pass without the key, and not with it.
  void ExpectFound(const std::string& what, const std::function<void(Events*)>& change) {
    SCOPED_TRACE(what);
    Events events = Read(file_.path());
    change(&events);
    const TemporaryFile forged;
    WriteAsForger(forged, events);
    EXPECT_TRUE(DamageOf(forged.path(), nullptr).empty());
    const std::vector<DamagedRange> damage = DamageOf(forged.path(), &key_);
    ASSERT_FALSE(damage.empty());
    EXPECT_TRUE(damage.front().forged);
  }

  const Secret key_;
  const TemporaryFile file_;
};

TEST_F(KeyedLog, IsWholeForWhoHasTheKeyAndForAllOthers) {
  EXPECT_TRUE(DamageOf(file_.path(), &key_).empty());
  EXPECT_TRUE(DamageOf(file_.path(), nullptr).empty());
}

TEST_F(KeyedLog, ChangesAreFoundThoughAllOtherChecksumsAreRight) {
  Random random(5);
  ExpectFound("a time", [](Events* e) { e->front().timestamp_us += 1; });
  for (int i = 0; i < 20; ++i) {
    ExpectFound("a word", [&](Events* events) {
      LogEvent* event = nullptr;
      do event = &(*events)[random.Next() % events->size()];
      while (event->channel.find("event") == std::string::npos);
      event->data.back() = static_cast<std::uint8_t>('a' + random.Next() % 20);
      event->data[event->data.size() - 2] ^= 1;
    });
  }
  ExpectFound("taken out", [](Events* e) { e->erase(e->begin() + 5); });
  ExpectFound("a stretch taken out", [](Events* e) { e->erase(e->begin() + 5, e->begin() + 10); });
  ExpectFound("its begin taken out", [](Events* e) { e->erase(e->begin(), e->begin() + 5); });
  ExpectFound("doubled", [](Events* e) { e->insert(e->begin() + 7, (*e)[3]); });
  ExpectFound("in another order", [](Events* e) { std::swap((*e)[1], (*e)[7]); });
}

TEST_F(KeyedLog, PartsOfAnotherLogWithTheSameKeyAreFound) {
  const TemporaryFile other;
  {
    RoomLog log(other.path(), true, nullptr, &key_);
    WriteTicks(&log, 0, 40, "lies");
  }
  const Events lies = Read(other.path());
  ExpectFound("a stretch of it", [&](Events* events) {
    std::copy(lies.begin() + 5, lies.begin() + 10, events->begin() + 5);
  });
}

TEST_F(KeyedLog, OtherKeysAndLogsWithoutOneAreNotItsWriters) {
  const Secret other = KeyOf(2);
  EXPECT_FALSE(DamageOf(file_.path(), &other).empty());
  const TemporaryFile plain;
  {
    RoomLog log(plain.path(), true, nullptr);
    WriteTicks(&log, 0, 40, "tick");
  }
  const std::vector<DamagedRange> damage = DamageOf(plain.path(), &key_);
  ASSERT_EQ(damage.size(), 1u);
  EXPECT_TRUE(damage[0].forged);
}

TEST_F(KeyedLog, AChangeIsNamedByTheTicksOfItsStretch) {
  Events events = Read(file_.path());
  events[21].data.back() ^= 0x20;
  const TemporaryFile forged;
  WriteAsForger(forged, events);
  const std::vector<DamagedRange> damage = DamageOf(forged.path(), &key_);
  ASSERT_EQ(damage.size(), 1u);
  EXPECT_GE(damage[0].first_tick, 15);
  EXPECT_LE(damage[0].last_tick, 24);
  EXPECT_FALSE(damage[0].to_the_end);
}

TEST_F(KeyedLog, GoesOnWhereItWasPinned) {
  const TemporaryFile file;
  LogPlace place;
  {
    RoomLog log(file.path(), true, nullptr, &key_);
    WriteTicks(&log, 0, 10, "tick");
    place = log.Pin();
    WriteTicks(&log, 10, 15, "lost");
  }
  {
    RoomLog log(file.path(), place, nullptr, &key_);
    WriteTicks(&log, 10, 30, "tick");
  }
  EXPECT_TRUE(DamageOf(file.path(), &key_).empty());
  LogReader tail(file.path(), place, &key_);
  for (LogEvent event; tail.Next(&event);) continue;
  EXPECT_TRUE(tail.damage().empty());
}

}  // namespace keyed_log_test
}  // namespace seam
