/// The figures of quite different methods, side by side.

#include <gtest/gtest.h>

#include "tests/lab/rivals/rivals.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace lab_rivals_test {

RivalFigures FiguresOf(const std::string& mode, const std::string& impair) {
  SessionSettings settings;
  settings.scene = "scenes/headon.toml";
  settings.mode = mode;
  settings.impair = impair;
  settings.drive = "bot";
  settings.duration_s = 4;
  return MeasureRival(settings, LoadSceneWith(settings.scene, {}));
}

TEST(LabRivals, CountTheTimeInWhichAPictureStands) {
  Recording recording;
  recording.room.tick_hz = 50;  // 20 ms a tick
  for (std::int64_t tick = 0; tick <= 50; ++tick) {
    recording.view_us[0][tick] = 40000 * tick;
    recording.view_us[1][tick] = 20000 * tick + (tick > 30 ? 100000 : 0);
    recording.view_us[2][tick] = 20000 * tick + (tick % 2 == 0 ? 0 : 9000);  // uneven
  }
  RivalFigures figures;
  MeasureFrozen(recording, &figures);
  EXPECT_DOUBLE_EQ(figures.speed, 0.5);
  EXPECT_DOUBLE_EQ(figures.frozen_longest_ms, 100);
  EXPECT_NEAR(figures.frozen_ms_per_s, 1000 * 0.1 / (1.08 + 0.971), 0.001);
}

TEST(LabRivals, LockstepIsExactAndStandsOnAWayThatIsTooLong) {
  const RivalFigures near = FiguresOf("lockstep", "delay=20ms");
  EXPECT_EQ(near.invalid, "");
  EXPECT_EQ(near.measures.error_max_m, 0);
  EXPECT_EQ(near.measures.seen, 0);
  EXPECT_EQ(near.frozen_ms_per_s, 0);
  EXPECT_NEAR(near.speed, 1, 0.01);
  EXPECT_GT(near.kbps, 0);
  EXPECT_GT(near.measures.response_own_ms.value_or(0), 130) << "the delay is 133 ms";
  const RivalFigures far = FiguresOf("lockstep", "delay=120ms");
  EXPECT_EQ(far.measures.error_max_m, 0);
  EXPECT_GT(far.frozen_ms_per_s, 50);
  EXPECT_LT(far.speed, 0.9);
}

TEST(LabRivals, RollbackOfInputsGuessesOthersAndRespondsSooner) {
  const RivalFigures ggpo = FiguresOf("ggpo", "delay=40ms");
  EXPECT_EQ(ggpo.invalid, "");
  EXPECT_GT(ggpo.measures.error_others_m.value_or(0), 0);
  EXPECT_LT(ggpo.measures.response_own_ms.value_or(1000), 100) << "the delay is 50 ms";
  EXPECT_GT(ggpo.stepped_again, 0);
}

}  // namespace lab_rivals_test
}  // namespace seam
