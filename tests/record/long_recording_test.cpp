/// Rooms that run for years: sequence numbers beyond 32 bits.

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "common/record/recording.h"

namespace seam {
namespace long_recording_test {

Stats Numbered(std::int64_t sequence, std::int64_t tick) {
  Stats stats;
  stats.peer = 1;
  stats.tick = tick;
  stats.sequence = sequence;
  return stats;
}

TEST(LongRecording, SequencesBeyond32BitsAreKeptAndTheirGapsCounted) {
  const std::string channel = ChannelName("r", "stats", 1);
  const std::int64_t limit = std::int64_t{1} << 31;  // 414 days of 60 views a second
  for (const std::int64_t base : {limit, 2 * limit, 1000 * limit}) {
    Room room;
    room.room = "r";
    room.scene_name = "crossing";
    room.scene_text = "[scene]\n";
    RecordingBuilder builder;
    ASSERT_TRUE(builder.Add(ChannelName("r", "room"), Encode(room)));
    for (const std::int64_t n : {-2, -1, 0, 1, 5, 6}) {  // 2, 3 and 4 are lost
      EXPECT_TRUE(builder.Add(channel, Encode(Numbered(base + n, n + 10)))) << base << " " << n;
    }
    EXPECT_FALSE(builder.Add(channel, Encode(Numbered(base + 6, 16)))) << "heard twice";
    const std::vector<Stats>& stats = builder.recording().stats.at(1);
    ASSERT_EQ(stats.size(), 6u);
    EXPECT_EQ(stats.back().sequence, base + 6);
    EXPECT_EQ(builder.recording().bus_gaps, 3) << base;
    EXPECT_EQ(builder.recording().duplicates, 1) << base;
  }
}

}  // namespace long_recording_test
}  // namespace seam
