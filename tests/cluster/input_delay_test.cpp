/// An input acts a fixed number of ticks after it was read, on every peer and in the oracle.

#include <gtest/gtest.h>

#include <cmath>

#include "client/embed/cluster.h"
#include "common/measure/measure.h"

namespace seam {
namespace input_delay_test {

/// A wheel that nothing moves before its motor does, in tick 31.
std::string WheelScene(int delay) {
  return "duration = 3\ngravity = [0, 0]\ninput_delay = " + std::to_string(delay) + R"(
[[player]]
name = "ann"
vehicle = "wheel"
region = [[-1000, -1000], [-0.001, 1000]]
script = [[0.5, {drive = 1.0}], [1.0, {}]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "hub"
position = [-5, 5]
circle = 0.2
anchored = true
[[part]]
name = "wheel"
position = [-5, 5]
circle = 1
owner = "ann"
[[joint]]
name = "axle"
kind = "hinge"
a = "hub"
b = "wheel"
motor = {player = "ann", speed = 5, torque = 100}
)";
}

ClusterConfig With(const std::string& mode, int delay) {
  ClusterConfig config;
  config.scene = "wheel";
  config.scene_text = WheelScene(delay);
  config.mode = mode;
  config.impair = "delay=40ms";
  return config;
}

/// The first tick in which `peer` shows a body that has turned; -1: none.
std::int64_t FirstMotion(const Recording& recording, int peer) {
  for (const auto& [tick, view] : recording.views.at(peer)) {
    for (const float angle : view.angle) {
      if (std::fabs(angle) > 1e-6f) return tick;
    }
  }
  return -1;
}

/// The same of the oracle.
std::int64_t FirstTrueMotion(const Recording& recording) {
  const Oracle oracle = ComputeOracle(recording);
  for (std::size_t row = 0; row < oracle.ticks.size(); ++row) {
    for (const BodyState& body : oracle.ticks[row]) {
      const bool turned = std::fabs(body.angle) > 1e-6f;
      if (turned) return oracle.first_tick + static_cast<std::int64_t>(row);
    }
  }
  return -1;
}

TEST(InputDelay, DelaysTheFirstMotionByItsTicksInSessionAndOracle) {
  constexpr int kDelay = 6;
  for (const char* mode : {"oracle", "strict", "buffer", "central"}) {
    SCOPED_TRACE(mode);
    const Recording at_once = RunCluster(With(mode, 0)), later = RunCluster(With(mode, kDelay));
    constexpr int kAnn = 1;
    ASSERT_GT(FirstMotion(at_once, kAnn), 0);
    EXPECT_EQ(FirstMotion(later, kAnn), FirstMotion(at_once, kAnn) + kDelay);
    ASSERT_GT(FirstTrueMotion(at_once), 0);
    EXPECT_EQ(FirstTrueMotion(later), FirstTrueMotion(at_once) + kDelay);
    EXPECT_EQ(FirstMotion(later, kAnn), FirstTrueMotion(later)) << "ann sees her own as it is";
  }
}

TEST(InputDelay, TheServerKnowsAnInputBeforeItsTick) {
  // 40 ms are 3 ticks: with a delay of 12, all are known in time, and all see the motion at once.
  const Recording recording = RunCluster(With("buffer", 12));
  EXPECT_EQ(FirstMotion(recording, 0), FirstTrueMotion(recording));
}

TEST(InputDelay, IsRecordedWithThePrediction) {
  ClusterConfig config = With("central", 6);
  config.duration_s = 0.5;
  config.predict = "own";
  const Room room = RunCluster(config).room;
  EXPECT_EQ(room.input_delay_ticks, 6);
  EXPECT_EQ(room.predict, "own");
  EXPECT_EQ(room.reconcile, "");
  config.predict = "";
  EXPECT_EQ(RunCluster(config).room.predict, "all");
  config.mode = "buffer";
  EXPECT_EQ(RunCluster(config).room.predict, "");
}

}  // namespace input_delay_test
}  // namespace seam
