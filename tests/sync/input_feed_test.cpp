#include "common/sync/inputs/input_feed.h"

#include <gtest/gtest.h>

#include <optional>

namespace seam {
namespace input_feed_test {

/// A player's inputs, and the messages with them to a peer in each tick.
struct InputFeedTest : ::testing::Test {
  /// Records the next tick's input; returns the message sent then.
  std::optional<Inputs> Step(const Input& input, bool rides = false) {
    track.Note(++tick, input);
    const int count = feed.Take(track, acked, tick, now_us, rides);
    if (count == 0) return std::nullopt;
    return track.Export(0, count);
  }
  static Input Drive(int drive) { return {static_cast<std::int8_t>(drive), 0, 0}; }

  InputTrack track;
  InputFeed feed;
  std::int64_t tick = 0, acked = -1, now_us = 0;
};

TEST_F(InputFeedTest, SendsAChangeInEveryTickUntilItIsAcknowledged) {
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(Step({})) << "nobody would guess otherwise";
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(Step(Drive(9))) << "tick " << tick;
  acked = 6;  // the tick of the change
  EXPECT_FALSE(Step(Drive(9)));
  EXPECT_TRUE(Step(Drive(8))) << "the next change";
}

TEST_F(InputFeedTest, SendsHeldInputsAlongWithOtherMessages) {
  acked = 0;
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(Step({}, false));
  const std::optional<Inputs> inputs = Step({}, true);
  ASSERT_TRUE(inputs);
  EXPECT_EQ(inputs->first_tick, 1) << "all that are not acknowledged";
  EXPECT_EQ(inputs->drive.size(), 5u);
  EXPECT_FALSE(feed.Take(track, acked, tick + 1, now_us, true)) << "nothing new, and no change";
}

TEST_F(InputFeedTest, SendsTheUnacknowledgedTicksAndAtLeastAFew) {
  for (int i = 0; i < 40; ++i) Step({});
  EXPECT_EQ(Step(Drive(1))->drive.size(), 16u) << "the most";
  acked = tick - 7;
  EXPECT_EQ(Step(Drive(2))->drive.size(), 8u);
  acked = tick;
  EXPECT_EQ(Step(Drive(3))->drive.size(), static_cast<std::size_t>(kInputsAtLeast));
}

TEST_F(InputFeedTest, AButtonIsAChangeWhenPressedAndReleased) {
  EXPECT_TRUE(Step({0, 0, 1}));
  acked = tick;
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(Step({0, 0, 1})) << "held, as everyone guesses";
  EXPECT_TRUE(Step({0, 0, 0}));
}

TEST_F(InputFeedTest, SendsOnceATickUnlessSomethingNewComes) {
  EXPECT_TRUE(Step(Drive(5)));
  EXPECT_FALSE(feed.Take(track, acked, tick, now_us, true)) << "the same tick again";
  track.Note(tick + 1, Drive(6));
  EXPECT_TRUE(feed.Take(track, acked, tick, now_us, false)) << "news, in the same tick of ours";
  EXPECT_TRUE(feed.Take(track, acked, tick + 1, now_us, false)) << "again: not acknowledged";
}

TEST_F(InputFeedTest, RepeatsWithinALongTickUntilAcknowledged) {
  EXPECT_TRUE(Step(Drive(5)));
  int sent = 0;
  for (now_us = 1000; now_us < 100000; now_us += 1000) {
    if (now_us > 70000) acked = tick;
    sent += feed.Take(track, acked, tick, now_us, false) > 0 ? 1 : 0;
  }
  EXPECT_EQ(sent, 3) << "after 20, 40 and 60 ms";
}

TEST_F(InputFeedTest, SendsEachInputWhereAPeerWaitsForIt) {
  track.Note(1, {});
  EXPECT_EQ(feed.TakeAll(track, acked, now_us), 2) << "-1 and 0 are not known, and cost nothing";
  EXPECT_EQ(feed.TakeAll(track, acked, now_us + kInputRepeatUs - 1), 0);
  EXPECT_GT(feed.TakeAll(track, acked, now_us + kInputRepeatUs), 0) << "again: it may be lost";
  acked = 1;
  for (std::int64_t t = 2; t <= 100; ++t) track.Note(t, {});
  EXPECT_EQ(feed.TakeAll(track, acked, now_us), static_cast<int>(kInputsMax));
  acked = 97;
  track.Note(101, {});
  EXPECT_EQ(feed.TakeAll(track, acked, now_us), 4);
  acked = 101;
  EXPECT_EQ(feed.TakeAll(track, acked, now_us + 10 * kInputRepeatUs), 0);
}

}  // namespace input_feed_test
}  // namespace seam
