/// The client's estimate of the room's clock never goes backwards and converges to the server's.

#include "client/room_timeline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace seam {
namespace room_timeline_test {

Pong At(std::int64_t utime, std::int64_t tick0_us, std::int32_t speed_ppm = kFullSpeedPpm) {
  Pong pong;
  pong.utime = utime;
  pong.tick0_us = tick0_us;
  pong.speed_ppm = speed_ppm;
  return pong;
}

TEST(RoomTimeline, AtFullSpeedItEqualsTheServersClockSinceTick0) {
  RoomTimeline timeline;
  EXPECT_FALSE(timeline.known());
  timeline.Add(At(1000, -1));
  EXPECT_FALSE(timeline.known()) << "the room still waits for players";
  timeline.Add(At(2000, 7000));
  ASSERT_TRUE(timeline.known());
  for (const std::int64_t us : {3000, 7000, 7001, 2000000000}) {
    EXPECT_EQ(timeline.At(us), us - 7000);
  }
  EXPECT_EQ(timeline.RealUs(12345), 12345);
}

TEST(RoomTimeline, AnOlderPongChangesNothing) {
  RoomTimeline timeline;
  timeline.Add(At(5000000, 1000000));
  timeline.Add(At(4000000, 2000000, 500000));
  EXPECT_EQ(timeline.speed_ppm(), kFullSpeedPpm);
  EXPECT_EQ(timeline.At(6000000), 5000000);
}

TEST(RoomTimeline, ReachesAClockThatSlowedEarlierWithoutGoingBackwards) {
  RoomTimeline timeline;
  timeline.Add(At(1000000, 1000000));
  std::int64_t last_us = timeline.At(2000000);
  ASSERT_EQ(last_us, 1000000);
  // The room's clock was put back by 0.3 s and runs at half its speed.
  timeline.Add(At(2000000, 1300000, 500000));
  EXPECT_EQ(timeline.RealUs(1000), 2000);
  for (std::int64_t us = 2000000; us < 5000000; us += 137) {
    const std::int64_t room_us = timeline.At(us);
    EXPECT_GE(room_us, last_us);
    EXPECT_LE(room_us - last_us, 137) << "and never faster than real time";
    last_us = room_us;
  }
  EXPECT_EQ(timeline.At(5000000), 700000 + 1500000);
}

TEST(RoomTimeline, AdvancesAsFarWhenPolledOftenAsWhenPolledSeldom) {
  RoomTimeline often, seldom;
  for (RoomTimeline* timeline : {&often, &seldom}) {
    timeline->Add(At(1000000, 0));
    timeline->At(2000000);
    timeline->Add(At(2000000, 500000, 250000));
  }
  for (std::int64_t us = 2000001; us <= 2100000; ++us) often.At(us);
  EXPECT_NEAR(static_cast<double>(often.At(2100000)), static_cast<double>(seldom.At(2100000)), 2);
}

}  // namespace room_timeline_test
}  // namespace seam
