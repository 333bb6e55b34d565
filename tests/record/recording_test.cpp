#include "common/record/recording.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "tests/support/random_messages.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace recording_test {

Room MakeRoom(std::int64_t seed = 7) {
  Room room;
  room.room = "r";
  room.scene_name = "crossing";
  room.scene_text = "[scene]\n";
  room.mode = "buffer";
  room.seed = seed;
  return room;
}

/// A view of peer 0..31 with `count` bodies; every number encodes the tick.
View MakeView(int peer, std::int64_t tick, std::size_t count = 2, std::int32_t first_id = 0) {
  View view;
  view.peer = peer;
  view.tick = tick;
  view.sequence = tick;
  for (std::size_t i = 0; i < count; ++i) {
    view.id.push_back(first_id + static_cast<int>(i));
  }
  view.role.assign(count, kRoleAuthority);
  view.authority.assign(count, static_cast<std::int16_t>(peer));
  view.x = view.y = view.angle = std::vector<float>(count, static_cast<float>(tick));
  view.vx = view.vy = view.spin = view.x;
  view.age.assign(count, 0);  // without a session, ages are not encoded
  return view;
}

Stats MakeStats(int peer, std::int64_t tick) {
  Stats stats;
  stats.peer = peer;
  stats.tick = tick;
  stats.sequence = tick;
  return stats;
}

/// A builder, and the channels that it hears.
struct Heard {
  RecordingBuilder builder;
  explicit Heard(const std::string& room = "") : builder(room) {}
  bool Hear(const Room& m) { return builder.Add(ChannelName("r", "room"), Encode(m)); }
  bool Hear(const View& m) { return builder.Add(ChannelName("r", "view", m.peer), Encode(m)); }
  bool Hear(const Stats& m) { return builder.Add(ChannelName("r", "stats", m.peer), Encode(m)); }
  bool Hear(const Inputs& m) {
    return builder.Add(ChannelName("r", "inputs", m.player), Encode(m));
  }
  Recording& recording() { return builder.recording(); }
};

TEST(ChannelNames, EncodeRoomKindAndPeer) {
  EXPECT_EQ(ChannelName("demo", "room"), "SEAM.demo.room");
  EXPECT_EQ(ChannelName("demo", "view", 12), "SEAM.demo.view.12");
  EXPECT_THROW(ChannelName("two words", "view"), OperatorError);
  EXPECT_THROW(ChannelName("a.b", "view"), OperatorError);
  EXPECT_THROW(ChannelName("", "view"), OperatorError);
  EXPECT_LE(ChannelName(std::string(32, 'x'), "impacts", 31).size(), kChannelBytesMax);
}

TEST(Recording, KeepsEveryKindOfMessage) {
  RandomMessages random(1);
  MemoryRecorder recorder;
  const auto publish = [&](const char* kind, auto message) {
    random.Fill(message);
    if constexpr (std::is_same_v<decltype(message), Room>) message.protocol = kProtocolVersion;
    recorder.Publish(ChannelName("r", kind), 0, Encode(message));
    return message;
  };
  const Room room = publish("room", Room{});
  const Inputs inputs = publish("inputs", Inputs{});
  const States states = publish("states", States{});
  const Grants grants = publish("grants", Grants{});
  const Meta meta = publish("meta", Meta{});
  const Impacts impacts = publish("impacts", Impacts{});
  const Stats stats = publish("stats", Stats{});
  const Load load = publish("load", Load{});
  const Event event = publish("event", Event{});
  View view = MakeView(3, 100);
  recorder.Publish(ChannelName("r", "view", 3), 0, Encode(view));

  const Recording& r = recorder.builder.recording();
  EXPECT_TRUE(recorder.builder.has_room());
  EXPECT_EQ(Fields(r.room), Fields(room));
  EXPECT_EQ(Fields(r.inputs.at(inputs.player).at(inputs.first_tick)), Fields(inputs));
  ASSERT_EQ(r.states.size(), 1u);
  EXPECT_EQ(Fields(r.states[0]), Fields(states));
  ASSERT_EQ(r.grants.size(), 1u);
  EXPECT_EQ(Fields(r.grants[0]), Fields(grants));
  ASSERT_EQ(r.meta.size(), 1u);
  EXPECT_EQ(Fields(r.meta[0]), Fields(meta));
  ASSERT_EQ(r.impacts.size(), 1u);
  EXPECT_EQ(Fields(r.impacts[0]), Fields(impacts));
  ASSERT_EQ(r.stats.at(stats.peer).size(), 1u);
  EXPECT_EQ(Fields(r.stats.at(stats.peer)[0]), Fields(stats));
  ASSERT_EQ(r.loads.size(), 1u);
  EXPECT_EQ(Fields(r.loads[0]), Fields(load));
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_EQ(Fields(r.events[0]), Fields(event));
  EXPECT_EQ(Fields(r.views.at(3).at(100)), Fields(view));
  EXPECT_EQ(r.events_read, 10);
  EXPECT_EQ(r.foreign + r.undecodable + r.bus_gaps + r.duplicates, 0);
}

TEST(Recording, PutsThePartsOfAViewTogetherInAnyOrder) {
  for (const std::vector<int>& order : {std::vector<int>{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}) {
    Heard heard;
    heard.Hear(MakeRoom());
    for (int n = 0; n < 3; ++n) {
      const int part = order[static_cast<std::size_t>(n)];
      View view = MakeView(1, 50, 4, 10 * part);
      view.part = part;
      view.parts = 3;
      view.sequence = part;
      EXPECT_TRUE(heard.recording().views.empty()) << "not before it is complete";
      EXPECT_TRUE(heard.Hear(view));
    }
    const View& whole = heard.recording().views.at(1).at(50);
    EXPECT_EQ(whole.id, (std::vector<std::int32_t>{0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23}));
    EXPECT_EQ(whole.parts, 1);
    EXPECT_EQ(whole.part, 0);
    for (const auto& v : {whole.x, whole.y, whole.angle, whole.vx, whole.vy, whole.spin}) {
      EXPECT_EQ(v, std::vector<float>(12, 50.0f));
    }
    EXPECT_EQ(whole.role.size(), 12u);
    EXPECT_EQ(whole.authority, std::vector<std::int16_t>(12, 1));
    EXPECT_EQ(heard.recording().bus_gaps, 0);
  }
}

TEST(Recording, PartsThatDoNotFitTogetherAreDamage) {
  Heard heard;
  heard.Hear(MakeRoom());
  for (int part = 0; part < 2; ++part) {
    View view = MakeView(1, 50, 4);  // the same ids twice
    view.part = part;
    view.parts = 2;
    view.sequence = part;
    heard.Hear(view);
  }
  EXPECT_TRUE(heard.recording().views.empty());
  EXPECT_EQ(heard.recording().undecodable, 1);
}

TEST(Recording, KeepsTheLastViewOfAPeerAndTick) {
  Heard heard;
  View view = MakeView(2, 5);
  heard.Hear(view);
  view.x[0] = 99;
  view.sequence = 6;
  heard.Hear(view);
  EXPECT_EQ(heard.recording().views.at(2).size(), 1u);
  EXPECT_EQ(heard.recording().views.at(2).at(5).x[0], 99);
}

TEST(Recording, CountsMissingMessagesByTheirSequenceNumbers) {
  Heard heard;
  heard.Hear(MakeRoom());
  for (const int tick : {500, 501, 504, 503, 510, 509, 509}) heard.Hear(MakeView(1, tick));
  for (const int tick : {8, 9, 10}) heard.Hear(MakeView(2, tick));
  const Recording& r = heard.recording();
  EXPECT_EQ(r.bus_gaps, 5) << "502, 505..508; a late one is not missing";
  EXPECT_EQ(r.gaps, (std::map<std::string, std::int64_t>{{"SEAM.r.view.1", 5}}));
  EXPECT_EQ(r.duplicates, 1);
  EXPECT_EQ(r.first_tick, 8);
  EXPECT_EQ(r.last_tick, 510);
}

TEST(Recording, APublisherThatStartsAgainIsNoGap) {
  Heard heard;
  for (int tick = 0; tick < 200; ++tick) heard.Hear(MakeView(1, tick));
  for (int tick = 200; tick < 400; ++tick) {
    View view = MakeView(1, tick);
    view.sequence = tick - 200;
    EXPECT_TRUE(heard.Hear(view));
  }
  EXPECT_EQ(heard.recording().bus_gaps, 0);
  EXPECT_EQ(heard.recording().views.at(1).size(), 400u);
}

TEST(Recording, GapsEqualTheLossesInAnyOrder) {
  Random random(11);
  Heard heard;
  constexpr int kSent = 3000;
  std::vector<int> arriving;
  for (int i = 0; i < kSent; ++i) {
    const bool edge = i == 0 || i == kSent - 1;  // beyond the ends nobody can tell
    if (edge || !random.Chance(0.1)) arriving.push_back(i);
    if (!edge && random.Chance(0.05)) arriving.push_back(arriving.back());
    if (arriving.size() > 3 && i < kSent - 1 && random.Chance(0.2)) {
      std::swap(arriving.back(), arriving[arriving.size() - 2]);
    }
  }
  for (const int i : arriving) heard.Hear(MakeView(1, i));
  const auto kept = static_cast<std::int64_t>(heard.recording().views.at(1).size());
  EXPECT_EQ(heard.recording().bus_gaps, kSent - kept);
  EXPECT_EQ(heard.recording().duplicates, static_cast<std::int64_t>(arriving.size()) - kept);
}

TEST(Recording, KeepsTheFirstRoomAndRefusesAnotherSession) {
  Heard heard;
  EXPECT_TRUE(heard.Hear(MakeRoom(7)));
  Room again = MakeRoom(7);
  again.utime = 5;
  again.sequence = 1;
  EXPECT_TRUE(heard.Hear(again)) << "repeated each second";
  Room other = MakeRoom(8);
  other.sequence = 2;
  EXPECT_FALSE(heard.Hear(other));
  EXPECT_EQ(heard.recording().room.seed, 7);
  EXPECT_EQ(heard.recording().room.utime, 0);
  EXPECT_EQ(heard.recording().foreign, 1);
}

TEST(Recording, ALogOfAnotherProtocolIsRefusedNamingBoth) {
  const TemporaryFile file;
  const auto refusal = [&](const Bytes& room) {
    LogWriter(file.path(), true).Publish(ChannelName("r", "scene"), 0, ByteView(room));
    try {
      ReadRecording(file.path());
    } catch (const OperatorError& e) {
      return std::string(e.what());
    }
    return std::string("read");
  };
  Room newer = MakeRoom();
  newer.protocol = kProtocolVersion + 1;
  EXPECT_EQ(refusal(Encode(newer)),
            file.path() + ": recorded with protocol 20; this program reads protocol 8 to 19");
  Room before = MakeRoom();
  before.protocol = 6;  // its bodies had ids of 16 bits
  EXPECT_EQ(refusal(Encode(before)),
            file.path() + ": recorded with protocol 6; this program reads protocol 8 to 19");
  before.protocol = kOldestReadableProtocol;
  EXPECT_EQ(refusal(Encode(before)), "read") << "on the bus nothing has changed since";
  // The beginning of protocol 2's room_t: hash, utime, sequence, protocol.
  const Bytes older = {0xfc, 0x29, 0x58, 0x2c, 0x30, 0xd1, 0x35, 0x4e, 0, 0, 0, 0, 0, 0,   0,
                       1,    0,    0,    0,    0,    0,    0,    0,    2, 0, 0, 0, 2, 'r', 0};
  EXPECT_EQ(refusal(older),
            file.path() + ": recorded with protocol 2; this program reads protocol 8 to 19");
  // And of protocol 3's, with 8 bytes of sequence.
  const Bytes third = {0xc7, 0xe4, 0x1b, 0x86, 0x53, 0x87, 0x67, 0xb7, 0, 0, 0, 0, 0, 0,   0, 1,
                       0,    0,    0,    0,    0,    0,    0,    0,    0, 0, 0, 3, 2, 'r', 0};
  EXPECT_EQ(refusal(third),
            file.path() + ": recorded with protocol 3; this program reads protocol 8 to 19");
}

TEST(Recording, SeparatesRoomsAndCountsForeignMessages) {
  RecordingBuilder first, second("second");
  for (RecordingBuilder* builder : {&first, &second}) {
    builder->Add("CAMERA", Bytes{1, 2, 3});
    builder->Add("SEAM.noise", Bytes{1});
    builder->Add(ChannelName("first", "view", 1), Encode(MakeView(1, 1)));
    builder->Add(ChannelName("second", "room"), Encode(MakeRoom(2)));
    builder->Add(ChannelName("first", "room"), Encode(MakeRoom(1)));
    builder->Add(ChannelName("first", "view", 1), Bytes{1, 2, 3});
    builder->Add(ChannelName("first", "ping"), Encode(Ping{}));
  }
  EXPECT_EQ(first.recording().room.seed, 1) << "the room of the first message";
  EXPECT_EQ(first.recording().foreign, 4);
  EXPECT_EQ(first.recording().undecodable, 1);
  EXPECT_EQ(second.recording().room.seed, 2);
  EXPECT_EQ(second.recording().foreign, 6);
  EXPECT_EQ(second.recording().undecodable, 0);
}

TEST(Recording, RedundantInputsKeepTheLongest) {
  Heard heard;
  Inputs inputs;
  inputs.player = 3;
  inputs.first_tick = 40;
  for (const std::size_t count : {2u, 5u, 3u}) {
    inputs.sequence += 1;
    inputs.drive.assign(count, 1);
    inputs.lift.assign(count, 0);
    inputs.buttons.assign(count, 0);
    EXPECT_TRUE(heard.Hear(inputs));
  }
  EXPECT_EQ(heard.recording().inputs.at(3).at(40).drive.size(), 5u);
}

TEST(Recording, SortsReorderedMessagesByTick) {
  Heard heard;
  for (const int tick : {60, 180, 120, 240, 0}) heard.Hear(MakeStats(1, tick));
  std::vector<std::int64_t> ticks;
  for (const Stats& s : heard.recording().stats.at(1)) ticks.push_back(s.tick);
  EXPECT_EQ(ticks, (std::vector<std::int64_t>{0, 60, 120, 180, 240}));
}

TEST(Recording, ADamagedTickDoesNotStretchTheSession) {
  Heard heard;
  heard.Hear(MakeView(1, std::int64_t{1} << 39));
  for (int tick = 1000; tick < 1100; ++tick) heard.Hear(MakeView(1, tick));
  heard.Hear(MakeView(2, std::int64_t{1} << 30));
  const Recording& r = heard.recording();
  EXPECT_EQ(r.first_tick, 1000);
  EXPECT_EQ(r.last_tick, 1099);
  EXPECT_EQ(r.views.at(1).size(), 100u);
  EXPECT_EQ(r.undecodable, 2);
}

TEST(Recording, UnfinishedViewsOfAHostileLogDoNotPileUp) {
  Heard heard;
  for (int tick = 0; tick < 5000; ++tick) {
    View view = MakeView(1, tick, 100);
    view.parts = kViewPartsMax;
    heard.Hear(view);
  }
  EXPECT_TRUE(heard.recording().views.empty());
}

TEST(ReadRecording, ReadsALogAndCountsItsDamage) {
  TemporaryFile file;
  {
    LogWriter writer(file.path());
    writer.Publish(ChannelName("r", "room"), 0, Encode(MakeRoom()));
    for (int tick = 0; tick < 100; ++tick) {
      writer.Publish(ChannelName("r", "view", 1), tick, Encode(MakeView(1, tick)));
    }
  }
  Bytes log = file.Read();
  const Recording whole = ReadRecording(file.path());
  EXPECT_EQ(whole.views.at(1).size(), 100u);
  EXPECT_EQ(whole.events_read, 101);
  EXPECT_EQ(whole.skipped_bytes, 0);

  for (std::size_t i = 2000; i < 2500; ++i) log[i] = 0x55;
  file.Write(log);
  const Recording damaged = ReadRecording(file.path());
  EXPECT_GT(damaged.skipped_bytes, 0);
  EXPECT_GE(damaged.views.at(1).size(), 94u);
  EXPECT_EQ(damaged.bus_gaps, 100 - static_cast<std::int64_t>(damaged.views.at(1).size()));

  EXPECT_NO_THROW(ReadRecording(file.path(), "r"));
  EXPECT_THROW(ReadRecording(file.path(), "other"), OperatorError);
  EXPECT_THROW(ReadRecording(file.path() + ".none"), OperatorError);
}

}  // namespace recording_test
}  // namespace seam
