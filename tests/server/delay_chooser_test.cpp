/// The delay that the ways of inputs need.

#include "server/delay_chooser.h"

#include <gtest/gtest.h>

#include "common/sync/inputs/input_delays.h"

namespace seam {
namespace delay_chooser_test {

void Add(DelayChooser* chooser, std::size_t player, std::int64_t way_us, int times) {
  for (int i = 0; i < times; ++i) chooser->Note(player, way_us);
}

TEST(DelayChooser, TakesTheWaysOfTheTwoFarthestPlayersInARow) {
  DelayChooser chooser(60, 3);
  EXPECT_FALSE(chooser.Needed()) << "nothing is known";
  Add(&chooser, 0, 20000, 100);
  EXPECT_EQ(chooser.Needed(), 2) << "20 ms";
  Add(&chooser, 1, 50000, 100);
  Add(&chooser, 2, 60000, 100);
  EXPECT_EQ(chooser.Needed(), 7) << "110 ms";
  chooser.Forget(2);
  EXPECT_EQ(chooser.Needed(), 5) << "70 ms";
}

TEST(DelayChooser, IsEnoughForAllButOneInAHundred) {
  DelayChooser chooser(60, 1);
  Add(&chooser, 0, 30000, 297);
  Add(&chooser, 0, 90000, 3);
  EXPECT_EQ(chooser.Needed(), 2) << "3 of 300 took longer";
  Add(&chooser, 0, 90000, 3);
  EXPECT_EQ(chooser.Needed(), 6) << "the oldest three are forgotten, and 6 of 300 took longer";
  Add(&chooser, 0, 5000000, 300);
  EXPECT_EQ(chooser.Needed(), kAdaptedDelayMax);
}

TEST(DelayChooser, GrowsAtOnceAndShrinksByTwoTicksOrMore) {
  DelayChooser chooser(60, 1);
  Add(&chooser, 0, 80000, 100);
  EXPECT_EQ(chooser.Choose(4), 5);
  EXPECT_FALSE(chooser.Choose(5));
  EXPECT_FALSE(chooser.Choose(6));
  EXPECT_EQ(chooser.Choose(7), 5);
}

}  // namespace delay_chooser_test
}  // namespace seam
