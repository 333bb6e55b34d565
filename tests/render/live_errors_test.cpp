/// The errors that a live page shows are those that its recording has.

#include "render/view/live_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/playback/playback.h"
#include "tests/lab/session.h"

namespace seam {
namespace live_errors_test {

Recording Recorded(const std::string& scene) {
  SessionSettings settings;
  settings.scene = "scenes/" + scene + ".toml";
  settings.impair = "4g";
  settings.duration_s = 5;
  Recording recording;
  RunSession(Configure(settings), &recording);
  return recording;
}

/// Hears a recording as it grows; what was heard is forgotten, but the last two seconds of views.
std::vector<LiveError> HeardLive(const Recording& whole) {
  Recording growing;
  growing.room = whole.room;
  LiveErrors live(growing);
  const std::int64_t end = whole.last_tick + 2 * whole.room.tick_hz;
  for (std::int64_t tick = 0; tick <= end; ++tick) {
    for (const auto& [player, pieces] : whole.inputs)
      for (const auto& [first, piece] : pieces)
        if (first == tick) growing.inputs[player][first] = piece;
    for (const auto& [number, edit] : whole.edits)
      if (edit.tick == tick) growing.edits[number] = edit;
    for (const auto& [peer, views] : whole.views) {
      const auto view = views.find(tick);
      if (view != views.end()) growing.views[peer][tick] = view->second;
      growing.views[peer].erase(growing.views[peer].begin(),
                                growing.views[peer].lower_bound(tick - 2 * whole.room.tick_hz));
    }
    live.Hear(growing);
    growing.inputs.clear();
    live.Advance(growing, std::min(tick, whole.last_tick + whole.room.tick_hz));
  }
  EXPECT_EQ(live.behind_s(end - whole.room.tick_hz), 0);
  return live.errors();
}

class LiveErrorsOf : public ::testing::TestWithParam<const char*> {};

TEST_P(LiveErrorsOf, ASessionAreThoseOfItsRecording) {
  const Recording recording = Recorded(GetParam());
  const std::vector<LiveError> live = HeardLive(recording);
  const Playback playback(recording, ComputeOracle(recording, JudgeOf(recording.room)));
  int compared = 0, apart = 0;
  for (const LiveError& error : live) {
    const auto recorded = playback.ErrorAt(error.peer, static_cast<double>(error.tick));
    if (!recorded) continue;
    ++compared;
    EXPECT_NEAR(error.error_m, *recorded, 1e-9) << error.peer << " at " << error.tick;
    apart += *recorded > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(compared, 500);  // three views of four seconds
  EXPECT_GT(apart, 20);
}

INSTANTIATE_TEST_SUITE_P(Scenes, LiveErrorsOf, ::testing::Values("crossing", "wall", "playground"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(LiveErrors, KeepNoMoreOfTheOracleThanTheyNeed) {
  Recording recording = Recorded("crossing");
  LiveErrors live(recording);
  live.Hear(recording);
  recording.views.clear();
  for (int i = 0; i < 1000 && live.behind_s(recording.last_tick) > 0; ++i)
    live.Advance(recording, recording.last_tick);
  EXPECT_EQ(live.behind_s(recording.last_tick), 0);
  std::size_t kept = 0;
  for (const auto& row : live.oracle().ticks) kept += row.empty() ? 0 : 1;
  EXPECT_LE(kept, 2u * static_cast<std::size_t>(recording.room.tick_hz) + 2);
}

TEST(LiveErrors, ForgetWhatNoPageShows) {
  const Recording recording = Recorded("crossing");
  LiveErrors live(recording);
  live.Hear(recording);
  const std::int64_t tick = 100 + recording.room.tick_hz;
  for (int i = 0; i < 1000 && live.behind_s(tick) > 0; ++i) live.Advance(recording, tick);
  ASSERT_FALSE(live.errors().empty());
  live.Forget(50);
  EXPECT_GE(live.errors().front().tick, 50);
  EXPECT_FALSE(live.errors().empty());
}

}  // namespace live_errors_test
}  // namespace seam
