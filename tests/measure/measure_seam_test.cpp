/// Compares peers' views with the authority's view, in recordings made by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/made_recording.h"

namespace seam {
namespace measure_seam_test {

TEST(Seam, APeerThatShowsTheAuthoritysStateHasNoSeamEvenIfBothErr) {
  const Recording run = MakeRecording(3, 100, Moving(2));
  const Measures m = Measure(run, MakeOracle(100, Moving(5)));
  EXPECT_GT(m.error_rms_m, 1);
  EXPECT_EQ(m.seam_rms_m, 0);
  EXPECT_EQ(m.seam_stutter_mps2, 0);
}

TEST(Seam, AnOffsetOfAFollowerIsItsSizeAndNoStutter) {
  Recording run = MakeRecording(2, 100, Moving(2));  // peer 0 has the authority over both bodies
  for (auto& [tick, view] : run.views[1]) view.x[0] += 0.5f;
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_DOUBLE_EQ(*m.seam_rms_m, 0.5 / std::sqrt(2));  // one of two bodies
  EXPECT_DOUBLE_EQ(*m.seam_stutter_mps2, 0);
}

TEST(Seam, AJumpOfAFollowerShowsInTwoSecondDifferences) {
  Recording run = MakeRecording(2, 100, Moving(2));
  for (auto& [tick, view] : run.views[1]) {
    if (tick >= 60) view.x[0] += 0.125f;
  }
  const Measures m = Measure(run, MakeOracle(100, Moving(2)));
  EXPECT_DOUBLE_EQ(*m.seam_stutter_mps2, 0.125 / (kH * kH) * std::sqrt(2.0 / 198));
}

TEST(Seam, AJumpOfTheAuthorityShowsInItsFollowers) {
  Recording run = MakeRecording(2, 100, Moving(2));
  for (auto& [tick, view] : run.views[0]) {
    if (tick >= 60) view.x[0] += 0.125f;
  }
  EXPECT_DOUBLE_EQ(*Measure(run, MakeOracle(100, Moving(2))).seam_rms_m,
                   0.125 * std::sqrt(41.0 / 202));
}

TEST(Seam, IsNotMeasuredWithoutFollowers) {
  EXPECT_FALSE(Measure(MakeRecording(1, 50, Moving(2)), MakeOracle(50, Moving(2))).seam_rms_m);
  // Nor in a tick in which the authority's own view does not claim the body.
  Recording run = MakeRecording(2, 50, Moving(2));
  for (auto& [tick, view] : run.views[0]) view.authority = {1, 1};
  for (auto& [tick, view] : run.views[1]) view.authority = {0, 0};
  EXPECT_FALSE(Measure(run, MakeOracle(50, Moving(2))).seam_rms_m);
}

}  // namespace measure_seam_test
}  // namespace seam
