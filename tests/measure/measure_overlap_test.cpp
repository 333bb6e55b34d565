/// Overlaps and stutter of views in the past, by the ticks that they say they show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/made_recording.h"

namespace seam {
namespace measure_overlap_test {

/// Two moving balls a metre apart, which touch.
Recording SideBySide(const Path& three) {
  Recording run = MakeRecording(2, 255, three);
  run.room.scene_name = "made";
  run.room.scene_text =
      std::string(kTwoBalls) + "[[player]]\nname = \"ann\"\nvehicle = \"three\"\n";
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      view.x[1] = static_cast<float>(2 * kH * static_cast<double>(tick));
      view.y[1] = 0;
    }
  }
  return run;
}

/// The oracle that shows what the recording does.
Oracle TruthOf(const Recording& run) { return OracleFromRecording(run); }

/// Moves at 2 m/s, one metre above the other ball; for `ticks` ticks, an odd number, it is more
/// than 5 cm lower, too slowly to be seen as a wrong velocity.
Path Sinking(int ticks) {
  return [ticks](std::int64_t tick) {
    const double from_middle = std::fabs(static_cast<double>(tick - 128));
    const double low = std::max(0.0, 0.05 + 0.0014 * (ticks / 2.0 - from_middle));
    return State(2 * kH * static_cast<double>(tick), 1 - (ticks > 0 ? low : 0), 2, 0);
  };
}

TEST(Overlap, FindsAnOverlapOfFiveCentimetresForEightyMilliseconds) {
  const Oracle apart = TruthOf(SideBySide(Sinking(0)));
  for (const int ticks : {5, 7, 21}) {  // 78, 109 and 328 ms
    const Measures m = Measure(SideBySide(Sinking(ticks)), apart);
    EXPECT_EQ(*m.seen > 0, ticks > 5) << ticks;
    // Of 72 + ticks ticks with an overlap one in a hundred is deeper.
    EXPECT_NEAR(*m.overlap_p99_m, 0.05 + 0.0014 * ticks / 2, 0.002) << ticks;
  }
}

TEST(Overlap, DoesNotCountAnOverlapThatTheOracleHasToo) {
  const Recording run = SideBySide(Sinking(21));
  const Measures m = Measure(run, TruthOf(run));
  EXPECT_EQ(m.seen, 0);
  EXPECT_EQ(m.overlap_p99_m, 0);
}

TEST(Overlap, JudgesAnOverlapByTheTicksThatAreShown) {
  // The view is 30 ticks late and says so: it overlaps when the oracle no longer does.
  Recording late = SideBySide([](std::int64_t tick) { return Sinking(21)(tick - 30); });
  for (auto& [tick, view] : late.views[1]) {
    view.x[1] -= static_cast<float>(60 * kH);
    view.age = {30, 30};
  }
  const Oracle truth = TruthOf(SideBySide(Sinking(21)));
  EXPECT_EQ(Measure(late, truth).overlap_p99_m, 0);
  for (auto& [tick, view] : late.views[1]) view.age = {0, 0};
  EXPECT_GT(*Measure(late, truth).overlap_p99_m, 0.04);
}

/// A vehicle on a winding road: never twice the same velocity.
BodyState Bending(double s) {
  return State(4 * s + std::sin(3 * s), 2 * std::cos(2 * s), 4 + 3 * std::cos(3 * s),
               -4 * std::sin(2 * s), std::sin(s));
}

Path Late(double seconds) {
  return [seconds](std::int64_t tick) {
    return Bending(std::max(0.0, static_cast<double>(tick) * kH - seconds));
  };
}

TEST(Stutter, IsJudgedByTheTickThatIsShown) {
  Recording run = MakeRecording(2, 512, Late(0));
  run.views[1] = MakeRecording(2, 512, [](std::int64_t tick) {
                   return Late(0)(std::max<std::int64_t>(0, tick - 7));
                 }).views[1];
  for (auto& [tick, view] : run.views[1]) view.age = {7, 7};
  const Measures m = Measure(run, MakeOracle(512, Late(0)));
  EXPECT_GT(m.stutter_mps2, 1) << "the oracle turns elsewhere";
  EXPECT_LT(m.stutter_shown_mps2, 0.05);
  EXPECT_EQ(m.backsteps, 0);
}

}  // namespace measure_overlap_test
}  // namespace seam
