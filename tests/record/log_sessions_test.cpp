/// One log, several sessions: each is read by itself.

#include "common/record/log_sessions.h"

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/loss_timeline.h"
#include "common/record/recording.h"
#include "common/record/time_range.h"
#include "tests/support/temporary_file.h"

namespace seam {
namespace log_sessions_test {

/// Writes a session of `ticks` ticks in which body 0 stands at `x`; the tick `lost` is missing.
void WriteSession(LogWriter* log, std::int64_t session, const std::string& mode, int ticks, float x,
                  int lost = -1) {
  Room room;
  room.session = session;
  room.room = "r";
  room.scene_name = "crossing";
  room.mode = mode;
  room.impair = "4g";
  room.seed = 2;
  room.utime = ticks;
  log->Publish(ChannelName("r", "scene"), 0, Encode(room));
  for (int tick = 0; tick < ticks; ++tick) {
    if (tick == lost) continue;
    View view;
    view.session = session;
    view.sequence = view.tick = tick;
    view.id = {0};
    view.role = {kRoleAuthority};
    view.authority = {0};
    view.x = {x};
    view.y = view.angle = view.vx = view.vy = view.spin = view.age = {0};
    log->Publish(ChannelName("r", "view", 0), tick, Encode(view));
  }
}

/// The line of the error; "" if the log is read.
std::string Refusal(const std::string& path, const std::string& session = "") {
  try {
    ReadRecording(path, "", session);
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

TEST(NewestSession, IsFollowedAndTheOneBeforeIsNot) {
  RecordingBuilder heard;
  const auto hear_room = [&](std::int64_t session, std::int64_t sequence) {
    Room room;
    room.session = session;
    room.sequence = sequence;
    room.room = "r";
    room.mode = "strict";
    return heard.Add(ChannelName("r", "scene"), Encode(room));
  };
  const auto hear_view = [&](std::int64_t session, std::int64_t tick) {
    View view;
    view.session = session;
    view.sequence = view.tick = tick;
    return heard.Add(ChannelName("r", "view", 0), Encode(view));
  };
  hear_room(11, 0);
  for (int tick = 0; tick < 5; ++tick) hear_view(11, tick);
  EXPECT_EQ(heard.recording().views.at(0).size(), 5u);
  EXPECT_TRUE(hear_room(22, 0)) << "the server was started anew, with the same settings";
  EXPECT_TRUE(heard.recording().views.empty());
  EXPECT_TRUE(hear_view(22, 0));
  EXPECT_FALSE(hear_view(11, 5)) << "of a client that has not noticed yet";
  EXPECT_FALSE(hear_room(11, 1));
  EXPECT_EQ(heard.recording().room.session, 22);
  EXPECT_EQ(heard.recording().views.at(0).size(), 1u);
  EXPECT_EQ(heard.recording().foreign, 2);
  EXPECT_EQ(heard.recording().bus_gaps, 0);
}

class LogSessions : public ::testing::Test {
 protected:
  const TemporaryFile file_;
};

TEST_F(LogSessions, EachIsReadByItselfAndTheLastByDefault) {
  {
    LogWriter log(file_.path());
    WriteSession(&log, 111, "strict", 50, 1);
    WriteSession(&log, 0x222, "central", 30, 2, 7);
    WriteSession(&log, 333, "strict", 70, 3);
  }
  const char* const names[] = {"1", "2", "3"};
  const std::size_t ticks[] = {50, 29, 70};
  for (std::size_t i = 0; i < 3; ++i) {
    const Recording one = ReadRecording(file_.path(), "", names[i]);
    ASSERT_EQ(one.views.at(0).size(), ticks[i]);
    for (const auto& [tick, view] : one.views.at(0)) {
      EXPECT_EQ(view.x.front(), static_cast<float>(i + 1));
    }
    EXPECT_EQ(one.bus_gaps, i == 1 ? 1 : 0);
    EXPECT_EQ(FindLosses(file_.path(), one).size(), i == 1 ? 2u : 0u) << "of the bus, and a view";
  }
  const Recording last = ReadRecording(file_.path());
  EXPECT_EQ(last.room.session, 333);
  EXPECT_EQ(last.sessions.size(), 3u);
  EXPECT_EQ(ChosenSession(last),
            "3 sessions: 1 (crossing, strict, 4g, seed 2, 51 events), 2 (crossing, central, 4g, "
            "seed 2, 30 events), 3 (crossing, strict, 4g, seed 2, 71 events); this is 3, the last "
            "(--session chooses)");
  EXPECT_EQ(ReadRecording(file_.path(), "", "0000000000000222").room.mode, "central");
}

TEST_F(LogSessions, TwoThatRunAtOnceAreToldApart) {
  TemporaryFile other;
  {
    LogWriter log(file_.path());
    WriteSession(&log, 1, "strict", 40, 1);
  }
  {
    LogWriter log(other.path());
    WriteSession(&log, 2, "strict", 40, 2);
  }
  // Event by event in turn, as a logger hears two servers of one room's name.
  LogReader a(file_.path()), b(other.path());
  TemporaryFile both;
  {
    LogWriter log(both.path());
    for (LogEvent one, two; a.Next(&one) && b.Next(&two);) {
      log.Publish(one.channel, one.timestamp_us, one.data);
      log.Publish(two.channel, two.timestamp_us, two.data);
    }
  }
  for (const char* name : {"1", "2"}) {
    const Recording one = ReadRecording(both.path(), "", name);
    EXPECT_EQ(one.views.at(0).size(), 40u);
    EXPECT_EQ(one.foreign, 41);
    EXPECT_EQ(one.duplicates + one.bus_gaps, 0);
    for (const auto& [tick, view] : one.views.at(0)) {
      EXPECT_EQ(view.x.front(), static_cast<float>(std::stoi(name)));
    }
  }
}

TEST_F(LogSessions, AnUnknownSessionIsRefusedWithTheList) {
  {
    LogWriter log(file_.path());
    WriteSession(&log, 9, "strict", 3, 1);
  }
  EXPECT_EQ(ChosenSession(ReadRecording(file_.path())), "") << "one session needs no line";
  EXPECT_EQ(SessionSuffix(ReadRecording(file_.path())), "");
  EXPECT_EQ(Refusal(file_.path(), "2"), "--session 2: " + file_.path() +
                                            " has 1 session: 1 (crossing, strict, 4g, seed 2, 4 "
                                            "events)");
  EXPECT_THROW(CheckSessions({"1"}, 2), OperatorError);
  CheckSessions({"1", "1"}, 2);
}

TEST_F(LogSessions, OlderLogsAreReadIfTheyHoldOneSessionAndRefusedIfMore) {
  {
    LogWriter log(file_.path());
    WriteSession(&log, 0, "strict", 50, 1);  // encoded without a session, as by protocol 12
  }
  EXPECT_EQ(ReadRecording(file_.path()).views.at(0).size(), 50u);
  const std::string why = "holds more than one session";
  for (const char* second : {"central", "strict"}) {
    LogWriter log(file_.path(), true);
    WriteSession(&log, 0, "strict", 50, 1);
    Room later;
    later.room = "r";
    later.mode = "strict";
    later.sequence = 1;
    later.scene_name = "crossing";
    later.impair = "4g";
    later.seed = 2;
    log.Publish(ChannelName("r", "scene"), 1000000, Encode(later));
    WriteSession(&log, 0, second, 30, 2);
    log.Flush();
    EXPECT_NE(Refusal(file_.path()).find(why), std::string::npos) << second;
  }
}

TEST(KeepRange, CutsTheLoadsOfTheServerToo) {
  Recording recording;
  recording.room.tick_hz = 60;
  for (int tick = 0; tick <= 600; tick += 60) {
    recording.loads.emplace_back().tick = tick;
    recording.views[0][tick].tick = tick;
  }
  TimeRange range;
  range.from_s = 2;
  range.to_s = 4;
  KeepRange(range, &recording);
  ASSERT_EQ(recording.loads.size(), 3u);
  EXPECT_EQ(recording.loads.front().tick, 120);
  EXPECT_EQ(recording.loads.back().tick, 240);
}

}  // namespace log_sessions_test
}  // namespace seam
