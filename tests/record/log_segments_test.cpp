/// Logs in segments: read as one, and each alone.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "common/record/room_log.h"
#include "tests/support/file_bytes.h"
#include "tests/support/program.h"

namespace seam {
namespace log_segments_test {

namespace fs = std::filesystem;

constexpr std::int64_t kSession = 77, kSegment = 6000;
constexpr const char* kScene = "the scene";

/// A room's server that publishes one message of each kind of which a Keyframe knows, and others.
class Writer {
 public:
  explicit Writer(RoomLog* log) : log_(log) {}

  void Ticks(std::int64_t from, std::int64_t to) {
    for (std::int64_t tick = from; tick < to; ++tick) {
      Tick(tick);
      ends.push_back(log_->Pin());
    }
  }

  std::vector<LogPlace> ends;  ///< of the ticks

 private:
  template <class Message>
  void Publish(Message message, std::int64_t number, int peer = -1) {
    message.session = kSession;
    message.sequence = static_cast<decltype(message.sequence)>(number);
    log_->Publish(ChannelName("r", MessageTraits<Message>::kKind, peer), utime_, Encode(message));
  }
  void Tick(std::int64_t tick) {
    utime_ = 1000000 + tick * 16667;
    if (tick % 20 == 0) {
      Room room;
      room.protocol = kProtocolVersion;
      room.room = "r";
      room.scene_text = kScene;
      room.tick_hz = 60;
      Publish(room, tick / 20);
    }
    Event event;
    event.tick = tick;
    event.text = "tick " + std::to_string(tick);
    Publish(event, tick, 0);
    EditOrder edit;
    edit.number = static_cast<std::int32_t>(tick);
    edit.tick = tick;
    Publish(edit, tick);
    Meta meta;
    meta.tick = tick;
    meta.kind = {kMetaPart, kMetaPart};
    meta.id = {static_cast<std::int32_t>(tick), 0};
    meta.key = {kMetaHealth, kMetaHealth};
    meta.value = {1, static_cast<float>(tick)};
    Publish(meta, tick);
    LogSeal seal;
    seal.utime = utime_;
    seal.session = kSession;
    seal.sequence = static_cast<std::int32_t>(tick);
    seal.tick = tick;
    seal.messages = -1;
    log_->EndTick(ChannelName("r", "chain", 0), seal, true);
  }

  RoomLog* log_;
  std::int64_t utime_ = 0;
};

struct Found {
  std::vector<std::pair<std::string, Bytes>> messages;  // without seals
  std::vector<DamagedRange> damage;
  std::int64_t skipped_bytes = 0;
  std::optional<std::int64_t> begins_after;
};

Found ReadAll(const std::string& path, const Secret* key = nullptr) {
  Found found;
  LogReader reader(path, key);
  for (LogEvent event; reader.Next(&event);) {
    if (std::holds_alternative<LogSeal>(Decode(event.data))) continue;
    found.messages.emplace_back(event.channel, event.data);
  }
  found.damage = reader.damage();
  found.skipped_bytes = reader.skipped_bytes();
  found.begins_after = reader.begins_after();
  return found;
}

/// A log in one file, and the same ticks in segments.
class LogSegments : public ::testing::Test {
 protected:
  LogSegments() {
    for (const std::string& log : {whole_, log_}) {
      fs::create_directory(fs::path(log).parent_path());
    }
    RoomLog one(whole_, false, nullptr);
    Writer(&one).Ticks(0, kTicks);
    RoomLog log(log_, false, nullptr, nullptr, kSegment);
    Writer writer(&log);
    writer.Ticks(0, kTicks);
    ends_ = writer.ends;
    segments_ = ListSegments(log_);
  }
  /// Returns the first and the last tick of a segment.
  std::pair<std::int64_t, std::int64_t> TicksIn(std::int32_t segment) const {
    std::vector<std::int64_t> ticks;
    for (std::size_t t = 0; t < ends_.size(); ++t) {
      if (ends_[t].segment == segment) ticks.push_back(static_cast<std::int64_t>(t));
    }
    return {ticks.front(), ticks.back()};
  }
  /// Expects that these ticks are damaged, and no others.
  void ExpectDamage(std::int64_t first, std::int64_t last) {
    const Found found = ReadAll(log_);
    ASSERT_EQ(found.damage.size(), 1u);
    EXPECT_EQ(found.damage[0].first_tick, first);
    EXPECT_EQ(found.damage[0].last_tick, last);
    EXPECT_FALSE(found.damage[0].to_the_end);
  }

  static constexpr std::int64_t kTicks = 100;
  Workspace folder_;
  const std::string whole_ = folder_ / "whole/one.lcm", log_ = folder_ / "kept/main.lcm";
  std::vector<LogPlace> ends_;
  std::vector<LogSegment> segments_;
};

TEST_F(LogSegments, AreReadAsTheLogInOneFile) {
  ASSERT_GT(segments_.size(), 4u);
  for (const LogSegment& segment : segments_) {
    const auto bytes = static_cast<std::int64_t>(fs::file_size(segment.path));
    EXPECT_LT(bytes, kSegment + 2000 + (segment.number > 0 ? 20000 : 0));
  }
  const Found whole = ReadAll(whole_);
  for (const std::string& path : {log_, folder_ / "kept"}) {
    const Found found = ReadAll(path);
    EXPECT_EQ(found.messages, whole.messages);
    EXPECT_TRUE(found.damage.empty());
    EXPECT_EQ(found.skipped_bytes, 0);
    EXPECT_FALSE(found.begins_after);
  }
  const Recording recording = ReadRecording(log_);
  EXPECT_EQ(recording.bus_gaps + recording.duplicates, 0);
}

TEST_F(LogSegments, ALogOfOneSegmentHasTheSameBytes) {
  const std::string path = folder_ / "large.lcm";
  RoomLog log(path, false, nullptr, nullptr, 1 << 20);
  Writer(&log).Ticks(0, kTicks);
  EXPECT_EQ(ReadBytes(path), ReadBytes(whole_));
}

TEST_F(LogSegments, EachAloneHasTheSceneEditsAndValuesOfBefore) {
  for (const LogSegment& segment : segments_) {
    if (segment.number == 0) continue;
    const auto [first, last] = TicksIn(segment.number);
    const Found found = ReadAll(segment.path);
    EXPECT_TRUE(found.damage.empty());
    EXPECT_EQ(found.skipped_bytes, 0);
    EXPECT_EQ(found.begins_after, first - 1);
    const Recording recording = ReadRecording(segment.path);
    EXPECT_EQ(recording.room.scene_text, kScene);
    EXPECT_EQ(recording.edits.size(), static_cast<std::size_t>(last + 1));
    EXPECT_EQ(recording.events.size(), static_cast<std::size_t>(last + 1 - first));
    std::map<std::int32_t, float> values;
    for (const Meta& meta : recording.meta) {
      for (std::size_t i = 0; i < meta.value.size(); ++i) values[meta.id[i]] = meta.value[i];
    }
    EXPECT_EQ(values.size(), static_cast<std::size_t>(last + 1));
    EXPECT_EQ(values[0], static_cast<float>(last));
    EXPECT_EQ(recording.bus_gaps + recording.duplicates, 0) << segment.number;
    EXPECT_TRUE(recording.damage.empty());
  }
}

TEST_F(LogSegments, AMissingOneIsNamedByItsTicks) {
  const auto [first, last] = TicksIn(2);
  fs::remove(segments_[2].path);
  ExpectDamage(first, last);
  ASSERT_EQ(mkfifo(segments_[2].path.c_str(), 0600), 0);  // nobody writes into it
  ExpectDamage(first, last);
}

TEST_F(LogSegments, ExchangedOnesAreNamed) {
  fs::rename(segments_[2].path, folder_ / "other");
  fs::rename(segments_[3].path, segments_[2].path);
  fs::rename(folder_ / "other", segments_[3].path);
  const Found found = ReadAll(log_);
  ASSERT_FALSE(found.damage.empty());
  EXPECT_EQ(found.damage.front().first_tick, TicksIn(2).first);
}

TEST_F(LogSegments, TheFirstOneIsNoneOfTheOthers) {
  fs::copy_file(log_, SegmentPath(log_, segments_.back().number + 1));
  EXPECT_FALSE(ReadAll(log_).damage.empty());
}

TEST_F(LogSegments, OneOfAnotherLogIsNamed) {
  Workspace other;
  RoomLog log(other / "main.lcm", false, nullptr, nullptr, kSegment + 500);
  Writer(&log).Ticks(0, kTicks);
  fs::copy_file(other / "main.s0002.lcm", segments_[2].path, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(ReadAll(log_).damage.empty());
  fs::copy_file(other / "main.lcm", segments_[2].path, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(ReadAll(log_).damage.empty()) << "a first one";
}

TEST_F(LogSegments, TheFirstOnesMayBeGone) {
  for (int i = 0; i < 3; ++i) fs::remove(segments_[static_cast<std::size_t>(i)].path);
  for (const std::string& path : {log_, folder_ / "kept"}) {
    const Found found = ReadAll(path);
    EXPECT_TRUE(found.damage.empty());
    EXPECT_EQ(found.begins_after, TicksIn(2).second);
    const Recording recording = ReadRecording(path);
    EXPECT_EQ(recording.edits.size(), static_cast<std::size_t>(kTicks));
    EXPECT_EQ(recording.bus_gaps + recording.duplicates, 0);
  }
}

/// Whatever a kill leaves of the segment that was being begun, the log goes on behind its last
/// whole tick, and is whole again.
TEST_F(LogSegments, GoOnWhereverTheChangeWasCutOff) {
  const LogSegment last = segments_.back();
  const Bytes good = ReadBytes(last.path);
  const std::int64_t tick = TicksIn(last.number).first;
  const LogPlace before = ends_[static_cast<std::size_t>(tick - 1)];
  const LogPlace first = ends_[static_cast<std::size_t>(tick)];
  ASSERT_EQ(before.segment, last.number - 1);
  const Found whole = ReadAll(whole_);
  std::vector<std::int64_t> cuts = {-1, 0, 1, 50, 100, 101, 150, 200};
  for (std::int64_t at = 300; at < first.bytes; at += 777) cuts.push_back(at);
  cuts.push_back(first.bytes - 1);
  for (const std::int64_t cut : cuts) {
    SCOPED_TRACE("cut at " + std::to_string(cut));
    for (const LogSegment& each : ListSegments(log_, last.number)) fs::remove(each.path);
    if (cut >= 0) WriteBytes(last.path, Bytes(good.begin(), good.begin() + cut));
    {
      LogReader reader(log_, ends_[10]);
      LogPlace end = ends_[10];
      for (LogEvent event; reader.Next(&event);) {
        const AnyMessage any = Decode(event.data);
        if (!std::holds_alternative<LogSeal>(any) || !reader.intact()) continue;
        end.bytes = reader.place_bytes();
        end.segment = reader.segment();
      }
      ASSERT_EQ(end.segment, before.segment) << "no place is within a keyframe";
      ASSERT_EQ(end.bytes, before.bytes);
    }
    RoomLog log(log_, before, nullptr, nullptr, kSegment);
    EXPECT_THROW(RoomLog(log_, before, nullptr), OperatorError) << "one writer at a time";
    Writer(&log).Ticks(tick, kTicks);
    const Found found = ReadAll(log_);
    EXPECT_EQ(found.messages, whole.messages);
    EXPECT_TRUE(found.damage.empty());
  }
}

TEST_F(LogSegments, AWriterKeepsOthersOffAllOfIt) {
  RoomLog log(log_, ends_.back(), nullptr, nullptr, kSegment);
  const Bytes third = ReadBytes(segments_[3].path);
  for (const std::size_t tick : {std::size_t{5}, ends_.size() / 2, ends_.size() - 1}) {
    EXPECT_THROW(RoomLog(log_, ends_[tick], nullptr), OperatorError);
  }
  EXPECT_THROW(RoomLog(log_, true, nullptr), OperatorError);
  EXPECT_EQ(ListSegments(log_).size(), segments_.size());
  EXPECT_EQ(ReadBytes(segments_[3].path), third);
}

TEST_F(LogSegments, OneThatCannotBeWrittenLeavesTheLogWhole) {
  const std::string path = folder_ / "full.lcm", next = folder_ / "full.s0001.lcm";
  RoomLog log(path, false, nullptr, nullptr, kSegment);
  Writer writer(&log);
  writer.Ticks(0, 3);
  WriteBytes(next, {1, 2, 3});
  writer.Ticks(3, kTicks);
  EXPECT_EQ(log.trouble().why(), next + ": cannot be written: File exists");
  EXPECT_GT(log.failures(), 0);
  EXPECT_EQ(ReadBytes(next), (Bytes{1, 2, 3}));
  fs::remove(next);
  const Found found = ReadAll(path);
  EXPECT_TRUE(found.damage.empty());
  EXPECT_EQ(found.skipped_bytes, 0);
  EXPECT_GE(log.Pin().bytes, kSegment);
  EXPECT_EQ(log.Pin().segment, 0);
}

TEST_F(LogSegments, WithAKeyTheSeriesIsItsWriters) {
  Secret key;
  key.data()[0] = 1;
  const std::string path = folder_ / "keyed.lcm";
  RoomLog log(path, false, nullptr, &key, kSegment);
  Writer(&log).Ticks(0, kTicks);
  const std::vector<LogSegment> segments = ListSegments(path);
  EXPECT_TRUE(ReadAll(path, &key).damage.empty());
  EXPECT_TRUE(ReadAll(segments[2].path, &key).damage.empty());
  EXPECT_FALSE(ReadAll(segments_[2].path, &key).damage.empty()) << "written without the key";
  fs::copy_file(segments_[2].path, segments[2].path, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(ReadAll(path, &key).damage.empty());
}

TEST(LogNamed, IsTheOneInAFolder) {
  Workspace folder;
  EXPECT_THROW(LogNamed(folder.path()), OperatorError);
  for (const char* name :
       {"main.s0002.lcm", "main.s0010.lcm", "main.lcm.damaged-1", "x.snapshot"}) {
    folder.Write(name, "");
  }
  EXPECT_EQ(LogNamed(folder.path()), folder / "main.lcm");
  const std::vector<LogSegment> segments = ListSegments(folder / "main.lcm");
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[1].number, 10);
  EXPECT_TRUE(ListSegments(folder / "main.s0002.lcm", 1).empty());
  folder.Write("other.lcm", "");
  try {
    LogNamed(folder.path());
    FAIL();
  } catch (const OperatorError& error) {
    EXPECT_EQ(error.what(), folder.path() + ": has several logs, name one: main.lcm, other.lcm");
  }
}

}  // namespace log_segments_test
}  // namespace seam
