/// Ticks of inputs: the delay with which they act, and the newest tick with all of them.

#include "common/sync/inputs/input_delays.h"

#include <gtest/gtest.h>

#include "common/sync/inputs/complete_inputs.h"
#include "common/sync/inputs/world_pieces.h"

namespace seam {
namespace input_delays_test {

Event Delay(std::int64_t tick, int ticks) {
  Event event = MakeEvent(EventKind::kInputDelay, "");
  event.tick = tick;
  event.value_milli = 1000 * ticks;
  return event;
}

TEST(InputDelays, CountFromHalfASecondAfterTheirEvent) {
  InputDelays delays(3);
  delays.Take(Delay(100, 9), 60);
  EXPECT_EQ(delays.At(129), 3);
  EXPECT_EQ(delays.At(130), 9);
  EXPECT_EQ(delays.newest(), 9);
  delays.Take(Delay(100, 9), 60);  // told twice
  delays.Take(Delay(500, kAdaptedDelayMax + 1), 60);
  delays.Take(MakeEvent(EventKind::kSpeed, ""), 60);
  EXPECT_EQ(delays.newest(), 9) << "the others are none, or no delays";
}

TEST(InputDelays, FindTheTickInWhichAnInputWasRead) {
  InputDelays grows(3);
  grows.Change(130, 9);
  EXPECT_EQ(grows.ReadTick(132), 129) << "the last one with the old delay";
  for (std::int64_t tick = 133; tick < 139; ++tick) {
    EXPECT_EQ(grows.ReadTick(tick), 129) << tick << " repeats it";
  }
  EXPECT_EQ(grows.ReadTick(139), 130);
  InputDelays shrinks(9);
  shrinks.Change(130, 3);
  EXPECT_EQ(shrinks.ReadTick(138), 129) << "it is known when the tick is read again";
  EXPECT_EQ(shrinks.ReadTick(139), 136) << "the inputs read between are left out";
}

TEST(CompleteInputs, ReachTheFirstTickThatAnyPlayerLacks) {
  std::vector<InputTrack> inputs(2);
  CompleteInputs complete(inputs);
  EXPECT_EQ(complete.Tick(), 0);
  for (std::int64_t tick = 1; tick <= 9; ++tick) inputs[0].Note(tick, {});
  EXPECT_EQ(complete.Tick(), 0);
  for (const std::int64_t tick : {1, 2, 4}) inputs[1].Note(tick, {});
  EXPECT_EQ(complete.Tick(), 2) << "tick 3 is missing";
  inputs[1].Note(3, {});
  EXPECT_EQ(complete.Tick(), 4);
  complete.StartAt(7);
  inputs[1].Note(8, {});
  EXPECT_EQ(complete.Tick(), 8);
}

TEST(WorldPieces, AreTheWorldInARowAgain) {
  Bytes world(5000);
  for (std::size_t i = 0; i < world.size(); ++i) {
    world[i] = static_cast<std::uint8_t>(i * i * 2654435761u >> 13);
  }
  const std::vector<Chunk> pieces = ToWorldPieces(ByteView(world.data(), world.size()), 7);
  ASSERT_GT(pieces.size(), 1u);
  Bytes row;
  for (const Chunk& piece : pieces) {
    EXPECT_FALSE(IsWholeWorld(row));
    EXPECT_EQ(piece.offset_bytes, static_cast<std::int32_t>(row.size()));
    row.insert(row.end(), piece.data.begin(), piece.data.end());
  }
  EXPECT_TRUE(IsWholeWorld(row));
  EXPECT_EQ(WorldOf(row), world);
  row[row.size() / 2] ^= 1;
  EXPECT_FALSE(WorldOf(row)) << "damaged";
}

}  // namespace input_delays_test
}  // namespace seam
