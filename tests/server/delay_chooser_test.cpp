/// The delay that the ways of inputs need.

#include "server/delay_chooser.h"

#include <gtest/gtest.h>

#include "common/sync/settings/live_settings.h"
#include "server/delay_history.h"

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

TEST(DelayHistory, FindsTheTickInWhichAnInputWasRead) {
  DelayHistory grows(3);
  grows.Change(130, 9);
  EXPECT_EQ(grows.ReadTick(132), 129) << "the last one with the old delay";
  for (std::int64_t tick = 133; tick < 139; ++tick) {
    EXPECT_EQ(grows.ReadTick(tick), 129) << tick << " repeats it";
  }
  EXPECT_EQ(grows.ReadTick(139), 130);
  DelayHistory shrinks(9);
  shrinks.Change(130, 3);
  EXPECT_EQ(shrinks.ReadTick(138), 129) << "it is known when the tick is read again";
  EXPECT_EQ(shrinks.ReadTick(139), 136) << "the inputs read between are left out";
}

}  // namespace delay_chooser_test
}  // namespace seam
