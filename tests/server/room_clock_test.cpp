/// The room's clock: real time while the server keeps up, slower for everyone when it does not.

#include "server/room_clock.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace seam {
namespace room_clock_test {

constexpr int kHz = 60;
constexpr std::int64_t kPeriodUs = 1000000 / kHz;

/// A server in virtual time with ticks of `cost_us`.
struct BusyServer {
  RoomClock clock{kHz};
  std::int64_t now_us = 5000000;
  std::int64_t tick = 0;
  std::int64_t worst_late_us = 0;
  int said = 0;

  BusyServer() { clock.Start(now_us); }
  void RunFor(std::int64_t us, std::int64_t cost_us) {
    for (const std::int64_t end_us = now_us + us; now_us < end_us;) {
      now_us = std::max(now_us, clock.DueUs(tick + 1));
      worst_late_us = std::max(worst_late_us, now_us - clock.DueUs(tick + 1));
      // Like Server::Tick: several due ticks in one call.
      std::int64_t steps = 0;
      while (steps < 2 && clock.DueUs(tick + 1) <= now_us) ++tick, ++steps;
      if (clock.Note(now_us, tick)) ++said;
      now_us += steps * cost_us;
    }
  }
};

TEST(RoomClock, TicksKeepTheirScheduleWhileTheServerKeepsUp) {
  BusyServer server;
  server.RunFor(20000000, kPeriodUs / 2);
  EXPECT_EQ(server.clock.speed_ppm(), kFullSpeedPpm);
  EXPECT_EQ(server.said, 0);
  for (const std::int64_t tick : {0, 1, 7, 3600, 216000}) {
    EXPECT_EQ(server.clock.DueUs(tick), 5000000 + tick * 1000000 / kHz);
  }
  EXPECT_EQ(server.clock.Tick0Us(server.now_us), 5000000);
}

TEST(RoomClock, ATickOfTwicePeriodHalvesTheSpeedAndBoundsTheLateness) {
  BusyServer server;
  server.RunFor(3000000, 2 * kPeriodUs);  // to notice
  server.worst_late_us = 0;
  const std::int64_t before = server.tick, begin_us = server.now_us;
  server.RunFor(30000000, 2 * kPeriodUs);
  const double speed = static_cast<double>(server.tick - before) * 1e6 / kHz /
                       static_cast<double>(server.now_us - begin_us);
  EXPECT_GT(speed, 0.45) << "what it can do is done";
  EXPECT_LE(speed, 0.501);
  EXPECT_LT(server.worst_late_us, 500000) << "it does not fall further and further behind";
  EXPECT_GE(server.said, 1);
  EXPECT_LE(server.said, 3) << "people are told, but not each second";
}

TEST(RoomClock, TheSpeedReturnsToRealTimeAfterTheLoad) {
  BusyServer server;
  server.RunFor(10000000, 2 * kPeriodUs);
  ASSERT_LT(server.clock.speed_ppm(), 700000);
  server.RunFor(40000000, kPeriodUs / 4);
  EXPECT_EQ(server.clock.speed_ppm(), kFullSpeedPpm);
  const std::int64_t tick = server.tick, begin_us = server.now_us;
  server.RunFor(10000000, kPeriodUs / 4);
  EXPECT_NEAR(static_cast<double>(server.tick - tick),
              static_cast<double>(server.now_us - begin_us) * 1e-6 * kHz, 1.5);
}

TEST(RoomClock, OneStallIsCaughtUpWithoutSlowing) {
  BusyServer server;
  server.RunFor(3000000, kPeriodUs / 4);
  server.now_us += 2000000;  // suspended
  server.RunFor(5000000, kPeriodUs / 4);
  EXPECT_EQ(server.clock.speed_ppm(), kFullSpeedPpm);
  EXPECT_EQ(server.said, 0);
  EXPECT_EQ(server.tick, (server.now_us - 5000000) * kHz / 1000000);
}

TEST(RoomClock, ABurstOfWorkNeitherStopsTheRoomNorSlowsItForLong) {
  // Somebody joins: for a while each tick takes six periods, and then as little as before.
  for (const std::int64_t burst_us : {200000, 400000, 600000}) {
    BusyServer server;
    server.RunFor(3000000, kPeriodUs / 4);
    std::int32_t slowest = kFullSpeedPpm;
    for (const std::int64_t end_us = server.now_us + burst_us; server.now_us < end_us;) {
      server.RunFor(10000, 6 * kPeriodUs);
      slowest = std::min(slowest, server.clock.speed_ppm());
    }
    server.RunFor(2000000, kPeriodUs / 4);
    EXPECT_GE(slowest, 450000) << burst_us;
    EXPECT_EQ(server.clock.speed_ppm(), kFullSpeedPpm) << burst_us;
    EXPECT_LE(server.said, 2) << burst_us;
  }
}

TEST(RoomClock, AStoppedRoomIsBackInSixSeconds) {
  BusyServer server;
  server.RunFor(10000000, 20 * kPeriodUs);
  ASSERT_LT(server.clock.speed_ppm(), 70000);
  server.RunFor(6000000, kPeriodUs / 4);
  EXPECT_EQ(server.clock.speed_ppm(), kFullSpeedPpm);
}

TEST(RoomClock, ANeighbourThatTakesAThirdOfTheTimeCostsNoSpeed) {
  // It runs for 40 ms of each 120; the server needs a half of the rest.
  for (const std::int64_t slice_us : {10000, 40000, 80000}) {
    BusyServer server;
    std::int32_t slowest = kFullSpeedPpm;
    for (int turn = 0; turn < 300; ++turn) {
      server.RunFor(2 * slice_us, kPeriodUs / 3);
      server.now_us += slice_us;
      slowest = std::min(slowest, server.clock.speed_ppm());
    }
    EXPECT_EQ(slowest, kFullSpeedPpm) << slice_us;
    EXPECT_LT(server.worst_late_us, slice_us + 2 * kPeriodUs) << slice_us;
  }
}

TEST(RoomClock, UnderALastingLoadThePeopleAreToldOnce) {
  for (const std::int64_t cost_us : {kPeriodUs * 11 / 10, 2 * kPeriodUs, 5 * kPeriodUs}) {
    BusyServer server;
    server.RunFor(5000000, cost_us);
    const int said = server.said;
    server.RunFor(60000000, cost_us);
    EXPECT_GE(said, 1) << cost_us;
    EXPECT_LE(server.said - said, 1) << cost_us;
  }
}

TEST(RoomClock, TheSpeedHasABoundAndTheClockNeverRunsBackwards) {
  BusyServer server;
  std::int64_t room_us = -1;
  for (int i = 0; i < 200; ++i) {
    server.RunFor(300000, 300 * kPeriodUs);
    EXPECT_GE(server.clock.speed_ppm(), kLeastSpeedPpm);
    // The ticks that were done stay done: the clock stands for those that are to come.
    EXPECT_GE(server.clock.DueUs(server.tick + 1) - server.clock.DueUs(server.tick), kPeriodUs);
  }
  EXPECT_GT(server.tick, room_us);
  EXPECT_EQ(server.clock.speed_ppm(), kLeastSpeedPpm);
}

}  // namespace room_clock_test
}  // namespace seam
