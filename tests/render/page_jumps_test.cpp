/// Marks of visible corrections, on recordings with known jumps.

#include <gtest/gtest.h>

#include "render/page/jumps.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace page_jumps_test {

using namespace synthetic;

std::vector<PageEvent> JumpsOf(const Recording& recording) {
  return FindJumps(Playback(recording, MakeScene(), MakeOracle()));
}

TEST(PageJumps, AViewThatIsRightHasNone) { EXPECT_TRUE(JumpsOf(MakeRecording(0)).empty()); }

TEST(PageJumps, AStepOfATenthOfAMetreIsOneMarkAtItsTickAndBody) {
  Recording recording = MakeRecording(0);
  for (auto& [tick, view] : recording.views.at(2)) {
    for (std::size_t i = 0; i < view.id.size(); ++i)
      if (view.id[i] == 1 && tick >= 20) view.x[i] += 0.1f;
  }
  const std::vector<PageEvent> jumps = JumpsOf(recording);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_EQ(jumps[0].kind, std::string("correction"));
  EXPECT_EQ(jumps[0].peer, 2);
  EXPECT_EQ(jumps[0].body, 1);
  EXPECT_NEAR(static_cast<double>(jumps[0].tick), 20.5, 0.51) << "the tick of the step or the next";
  EXPECT_NEAR(jumps[0].size, 0.1, 0.002);
}

TEST(PageJumps, AStepOfAMillimetreIsNone) {
  Recording recording = MakeRecording(0);
  for (auto& [tick, view] : recording.views.at(2)) {
    if (tick >= 20) view.x[0] += 0.001f;
  }
  EXPECT_TRUE(JumpsOf(recording).empty());
}

}  // namespace page_jumps_test
}  // namespace seam
