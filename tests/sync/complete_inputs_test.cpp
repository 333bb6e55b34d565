/// The newest tick with all inputs, and a world in pieces.

#include "common/sync/inputs/complete_inputs.h"

#include <gtest/gtest.h>

#include "common/sync/inputs/world_pieces.h"

namespace seam {
namespace complete_inputs_test {

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

}  // namespace complete_inputs_test
}  // namespace seam
