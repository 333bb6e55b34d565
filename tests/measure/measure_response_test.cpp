/// From an input to motion on each screen, of recordings made by hand around a real oracle.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "client/embed/cluster.h"
#include "common/measure/screen/counterfactual.h"
#include "common/measure/screen/extent.h"
#include "common/measure/screen/response.h"
#include "tests/support/made_recording.h"

namespace seam {
namespace measure_response_test {

/// Nothing but a disc of pi/4 kg that its player pushes by a button, and another player's.
const char* const kScene = R"(
gravity = [0, 0]
[[part]]
name = "puck"
circle = 0.5
velocity = [2, 0]
[[part]]
name = "other"
circle = 0.5
position = [0, 50]
[[player]]
name = "anna"
vehicle = "puck"
actions = [{button = 0, part = "puck", impulse = [0, 1]}]
[[player]]
name = "bob"
vehicle = "other"
)";

constexpr std::int64_t kLast = 640;
constexpr std::int64_t kTickUs = 1000000 / kHz;

/// Anna presses at every 100th tick; nobody has shown anything.
Recording Pressed() {
  Recording run;
  run.room.scene_name = "made";
  run.room.scene_text = kScene;
  run.room.tick_hz = kHz;
  run.room.mode = "central";
  run.first_tick = 0;
  run.last_tick = kLast;
  for (std::int64_t first = 1; first <= kLast; first += 64) {
    Inputs inputs;
    inputs.first_tick = first;
    for (std::int64_t tick = first; tick < first + 64; ++tick) {
      inputs.drive.push_back(0);
      inputs.lift.push_back(0);
      inputs.buttons.push_back(tick % 100 == 0 ? 1 : 0);
    }
    run.inputs[0][first] = inputs;
  }
  return run;
}

/// The puck's pose on a screen at a tick.
using Screening = std::function<DoublePose(const Oracle&, std::int64_t)>;

/// The puck as it was `ticks` ago.
Screening Past(std::int64_t ticks) {
  return [ticks](const Oracle& oracle, std::int64_t tick) {
    return DoublePose(*oracle.At(std::max<std::int64_t>(0, tick - ticks), 0));
  };
}

/// The puck as it would be without the last press, until that has been heard of for `ticks`.
Screening Guessed(std::int64_t ticks) {
  return [ticks](const Oracle& oracle, std::int64_t tick) {
    const std::int64_t pressed = tick / 100 * 100;
    DoublePose pose(*oracle.At(tick, 0));
    if (pressed < 100 || tick >= pressed + ticks) return pose;
    const BodyState before = *oracle.At(pressed - 1, 0);
    const double s = static_cast<double>(tick - pressed + 1) * kH;
    pose.position = (before.position + static_cast<float>(s) * before.velocity).cast<double>();
    return pose;
  };
}

void Show(Recording* run, const Oracle& oracle, int peer, std::int64_t late_us,
          const Screening& screening) {
  for (std::int64_t tick = 0; tick <= kLast; ++tick) {
    View view;
    view.peer = peer;
    view.tick = tick;
    view.id = {0};
    view.role = {0};
    view.authority = {0};
    const DoublePose pose = screening(oracle, tick);
    view.x = {static_cast<float>(pose.position.x())};
    view.y = {static_cast<float>(pose.position.y())};
    view.angle = {0};
    view.vx = view.vy = view.spin = view.age = {0};
    run->views[peer][tick] = view;
    run->view_us[peer][tick] = 1000000 + tick * kTickUs + late_us;
  }
}

Measures Response(const Screening& own, const Screening& server, const Screening& other,
                  std::int64_t other_late_us = 0, int input_delay_ticks = 0) {
  Recording run = Pressed();
  const Oracle oracle = ComputeOracle(run);
  Show(&run, oracle, 0, 0, server);
  Show(&run, oracle, 1, 0, own);
  Show(&run, oracle, 2, other_late_us, other);
  Measures measures;
  run.room.input_delay_ticks = input_delay_ticks;
  MeasureResponse(run, oracle, &measures);
  return measures;
}

TEST(Response, TakesOneTickIfTheOracleIsShownAtOnce) {
  const Measures m = Response(Past(0), Past(0), Past(0));
  EXPECT_NEAR(m.response_own_ms.value(), 1000 * kH, 0.1);
  EXPECT_NEAR(m.response_server_ms.value(), 1000 * kH, 0.1);
  EXPECT_NEAR(m.response_other_ms.value(), 1000 * kH, 0.1);
}

TEST(Response, EqualsTheDelayOfAViewOfThePast) {
  const Measures m = Response(Past(0), Past(6), Past(20));
  EXPECT_NEAR(m.response_server_ms.value(), 7000 * kH, 0.1);
  EXPECT_NEAR(m.response_other_ms.value(), 21000 * kH, 0.1);
}

TEST(Response, EqualsTheTimeUntilAGuessIsCorrected) {
  const Measures m = Response(Past(0), Guessed(9), Guessed(25));
  EXPECT_NEAR(m.response_own_ms.value(), 1000 * kH, 0.1);
  EXPECT_NEAR(m.response_server_ms.value(), 10000 * kH, 0.1);
  EXPECT_NEAR(m.response_other_ms.value(), 26000 * kH, 0.1);
}

TEST(Response, CountsClockTimeNotTicks) {
  const Measures m = Response(Past(0), Past(0), Past(4), 50000);
  EXPECT_NEAR(m.response_other_ms.value(), 50 + 5000 * kH, 0.1);
}

TEST(Response, AnInputThatActsLaterWasReadEarlier) {
  const Measures m = Response(Past(0), Past(0), Past(0), 0, 5);
  EXPECT_NEAR(m.response_own_ms.value(), 6000 * kH, 0.1);
}

TEST(Response, IsUnknownIfAScreenNeverRespondsOrTimesAreMissing) {
  const Screening straight = [](const Oracle& oracle, std::int64_t tick) {
    return DoublePose({DoublePose(*oracle.At(tick, 0)).position.x(), 0}, 0);
  };
  const Measures m = Response(Past(0), Past(0), straight);
  EXPECT_TRUE(m.response_own_ms);
  EXPECT_FALSE(m.response_other_ms);
  Recording run = Pressed();
  const Oracle oracle = ComputeOracle(run);
  Show(&run, oracle, 1, 0, Past(0));
  run.view_us.clear();
  Measures none;
  MeasureResponse(run, oracle, &none);
  EXPECT_FALSE(none.response_own_ms);
}

TEST(Response, InASessionItIsATickOnTheOwnScreenAndTheNetworksDelayOnOthers) {
  for (const char* mode : {"buffer", "central"}) {
    ClusterConfig config;
    config.mode = mode;
    config.impair = "demo";
    config.drive = Drive::kBot;
    const Recording run = RunCluster(config);
    ASSERT_EQ(run.view_us.size(), 3u);
    ASSERT_EQ(run.view_us.at(2).size(), run.views.at(2).size());
    Measures m;
    MeasureResponse(run, ComputeOracle(run), &m);
    EXPECT_NEAR(m.response_own_ms.value(), 17, 3) << mode;
    EXPECT_GT(m.response_other_ms.value(), 100) << mode;  // 50 ms to the server and as many on
    EXPECT_LT(m.response_other_ms.value(), 300) << mode;
  }
}

TEST(Response, SamplesTheRecordedChangesEvenly) {
  const InputTape tape = TapeOf(Pressed());
  const auto all = ChangesOf(tape, 1, kLast, 100);
  ASSERT_EQ(all.size(), 12u);  // six presses, and the ticks after them
  EXPECT_EQ(all[0].tick, 100);
  EXPECT_EQ(all[0].before.buttons, 0);
  EXPECT_EQ(all[1].tick, 101);
  const auto some = ChangesOf(tape, 1, kLast, 3);
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(some[1].tick, 300);
}

}  // namespace measure_response_test
}  // namespace seam
