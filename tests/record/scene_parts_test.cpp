/// Scenes that are too long for one message of the bus come in parts, and are read from a log
/// whatever the order, the losses and the beginning.

#include "common/record/scene_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/check.h"
#include "common/base/random.h"
#include "common/codec/codec.h"
#include "common/codec/validate.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace scene_parts_test {

constexpr std::int64_t kSession = 77;

/// A text that no compression makes short: `bytes` bytes of letters.
std::string Letters(std::size_t bytes, std::uint64_t seed = 1) {
  Random random(seed);
  std::string text(bytes, ' ');
  for (char& c : text) c = static_cast<char>('A' + random.Next() % 64 % 57);
  return text;
}

Room LongRoom() {
  Room room;
  room.room = "r";
  room.mode = "buffer";
  room.session = kSession;
  return room;
}

/// A builder that hears rooms and parts, and numbers them.
struct Listener {
  RecordingBuilder builder;
  std::int64_t rooms = 0, parts = 0;
  bool Hear(Room room) {
    room.sequence = rooms++;
    return builder.Add(ChannelName("r", "scene"), Encode(room));
  }
  bool Hear(ScenePart part, std::int64_t session = kSession) {
    part.session = session;
    part.sequence = parts++;
    return builder.Add(ChannelName("r", "scene_part"), Encode(part));
  }
  const std::string& text() { return builder.recording().room.scene_text; }
};

TEST(SceneParts, OnlyTheLastPartOfASceneIsShort) {
  ScenePart part;
  part.session = 1;
  part.parts = 3;
  part.part = 1;
  part.data.assign(kScenePartBytes, 7);
  EXPECT_TRUE(Valid(part));
  part.data.pop_back();
  EXPECT_FALSE(Valid(part)) << "a short part in the middle";
  part.part = 2;
  EXPECT_TRUE(Valid(part));
  part.data.clear();
  EXPECT_FALSE(Valid(part)) << "an empty part";
  part.data.assign(kScenePartBytes + 1, 7);
  EXPECT_FALSE(Valid(part)) << "too long";
  part.data.assign(1, 7);
  part.parts = kScenePartsMax + 1;
  part.part = part.parts - 1;
  EXPECT_FALSE(Valid(part)) << "more parts than the longest scene has";
  part.parts = 0;
  part.part = -1;
  EXPECT_FALSE(Valid(part));
  part.part = 0;
  part.parts = 1;
  EXPECT_TRUE(Valid(part));
  part.session = 0;
  EXPECT_FALSE(Valid(part)) << "of no session";
}

TEST(SceneParts, ATextComesBackFromItsPartsInAnyOrder) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{200000}, kSceneTextBytesMax}) {
    const std::string text = Letters(size);
    std::vector<ScenePart> all = CutScene(text);
    EXPECT_LE(all.size(), static_cast<std::size_t>(kScenePartsMax));
    std::reverse(all.begin(), all.end());
    SceneParts parts;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_FALSE(parts.whole());
      EXPECT_EQ(parts.have(), static_cast<int>(i));
      EXPECT_TRUE(parts.Take(all[i]));
    }
    ASSERT_TRUE(parts.whole());
    EXPECT_EQ(parts.TakeText(), text);
  }
}

TEST(SceneParts, ARecordingHasTheSceneWhicheverCameFirst) {
  const std::string text = Letters(150000);
  const std::vector<ScenePart> all = CutScene(text);
  ASSERT_GT(all.size(), 3u);
  for (const std::size_t room_at : {std::size_t{0}, std::size_t{2}, all.size()}) {
    Listener bus;
    for (std::size_t i = 0; i <= all.size(); ++i) {
      if (i == room_at) {
        EXPECT_TRUE(bus.Hear(LongRoom()));
      }
      EXPECT_FALSE(bus.builder.has_scene() && i < all.size());
      if (i < all.size()) {
        EXPECT_TRUE(bus.Hear(all[i]));
      }
    }
    EXPECT_TRUE(bus.builder.has_scene()) << room_at;
    EXPECT_EQ(bus.text(), text);
    // The Room comes again without its scene, the parts come again, and nothing changes.
    EXPECT_TRUE(bus.Hear(LongRoom()));
    for (const ScenePart& part : all) EXPECT_TRUE(bus.Hear(part));
    EXPECT_EQ(bus.text(), text);
    EXPECT_EQ(bus.builder.recording().foreign, 0);
    EXPECT_EQ(bus.builder.recording().bus_gaps, 0);
    EXPECT_FALSE(bus.builder.recording().mixed);
  }
}

TEST(SceneParts, LostPartsAreTakenFromALaterTurn) {
  const std::string text = Letters(150000);
  const std::vector<ScenePart> all = CutScene(text);
  Listener late;  // begins in the middle of a turn, and loses one of each
  for (std::size_t i = 2; i < all.size(); ++i) late.Hear(all[i]);
  for (std::size_t i = 1; i < all.size(); ++i) late.Hear(all[i]);
  EXPECT_TRUE(late.Hear(LongRoom()));
  EXPECT_FALSE(late.builder.has_scene());
  EXPECT_TRUE(late.Hear(all[0]));
  EXPECT_EQ(late.text(), text);
}

TEST(SceneParts, PartsOfAnotherSessionAreNotMixedIn) {
  const std::string one = Letters(150000, 1), two = Letters(150000, 2);
  const std::vector<ScenePart> of_one = CutScene(one), of_two = CutScene(two);
  Listener bus;
  EXPECT_TRUE(bus.Hear(LongRoom()));
  EXPECT_TRUE(bus.Hear(of_one[0]));
  EXPECT_FALSE(bus.Hear(of_two[1], kSession + 1)) << "its Room did not come";
  for (std::size_t i = 1; i < of_one.size(); ++i) bus.Hear(of_one[i]);
  EXPECT_EQ(bus.text(), one);
  Room next = LongRoom();
  next.session = kSession + 1;
  EXPECT_TRUE(bus.Hear(next)) << "the newest session is followed";
  EXPECT_FALSE(bus.builder.has_scene());
  for (const ScenePart& part : of_two) bus.Hear(part, kSession + 1);
  EXPECT_EQ(bus.text(), two);
}

TEST(SceneParts, HostilePartsAreCountedAndLeaveNothing) {
  const std::string text = Letters(150000);
  const std::vector<ScenePart> all = CutScene(text);
  Listener bus;
  bus.Hear(LongRoom());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ScenePart part = all[i];
    if (i == 1) part.data[5] ^= 1;
    bus.Hear(part);
  }
  EXPECT_FALSE(bus.builder.has_scene()) << "a damaged part";
  EXPECT_EQ(bus.builder.recording().undecodable, 1);
  EXPECT_EQ(bus.builder.scene_parts().have(), 0) << "it begins anew";
  ScenePart lone = all[0];
  lone.parts = 2;
  bus.Hear(lone);  // another number of parts: a text of its own
  const auto bytes = [](const std::string& content) {
    ScenePart part = CutScene(content)[0];
    part.parts = 1;
    return part;
  };
  bus.Hear(bytes("control \x1b[2J"));
  EXPECT_FALSE(bus.builder.has_scene()) << "no text";
  bus.Hear(bytes(std::string(kSceneTextBytesMax + 1, '#')));
  EXPECT_FALSE(bus.builder.has_scene()) << "longer than any scene, in a part of 200 bytes";
  EXPECT_EQ(bus.builder.recording().undecodable, 3);
  for (const ScenePart& part : all) bus.Hear(part);
  EXPECT_EQ(bus.text(), text) << "the next turn is good";
}

TEST(SceneParts, ALogWithTooFewOfThemSaysSo) {
  const TemporaryFile file;
  const std::vector<ScenePart> all = CutScene(Letters(150000));
  const auto write = [&](std::size_t count) {
    LogWriter log(file.path(), true);
    log.Publish(ChannelName("r", "scene"), 0, Encode(LongRoom()));
    for (std::size_t i = 0; i < count; ++i) {
      ScenePart part = all[i];
      part.session = kSession;
      part.sequence = static_cast<std::int64_t>(i);
      log.Publish(ChannelName("r", "scene_part"), 0, Encode(part));
    }
  };
  write(all.size());
  EXPECT_EQ(ReadRecording(file.path()).room.scene_text.size(), 150000u);
  write(2);
  try {
    ReadRecording(file.path());
    ADD_FAILURE() << "it was read";
  } catch (const OperatorError& error) {
    EXPECT_EQ(error.what(), file.path() + ": only 2 of " + std::to_string(all.size()) +
                                " parts of the scene are in this log: record for longer, they "
                                "come again");
  }
}

}  // namespace scene_parts_test
}  // namespace seam
