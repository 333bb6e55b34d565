/// The age of a view, its path, and the faults that a person would notice, in recordings made by
/// hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "client/embed/cluster.h"
#include "common/measure/screen/noticed.h"
#include "common/measure/screen/thresholds.h"
#include "tests/support/made_recording.h"

namespace seam {
namespace measure_seen_test {

/// A vehicle on a winding road: never twice the same velocity.
BodyState Winding(double s) {
  return State(4 * s + std::sin(3 * s), 2 * std::cos(2 * s), 4 + 3 * std::cos(3 * s),
               -4 * std::sin(2 * s), std::sin(s));
}

Path Delayed(double seconds) {
  return [seconds](std::int64_t tick) {
    return Winding(std::max(0.0, static_cast<double>(tick) * kH - seconds));
  };
}

/// Peer 1 shows `shown`, peer 0 and the oracle `truth`.
Measures Compare(const Path& truth, const Path& shown, std::int64_t last_tick = 512) {
  Recording run = MakeRecording(2, last_tick, truth);
  run.views[1] = MakeRecording(2, last_tick, shown).views[1];
  return Measure(run, MakeOracle(last_tick, truth));
}

TEST(ViewAge, EqualsTheDelayOfADelayedViewWithTheRightPath) {
  for (const int ticks : {0, 1, 7, 40}) {
    const Measures m = Compare(Delayed(0), [ticks](std::int64_t tick) {
      return Delayed(0)(std::max<std::int64_t>(0, tick - ticks));
    });
    EXPECT_NEAR(*m.view_age_ms, 1000 * ticks * kH, 0.5) << ticks;
    EXPECT_LT(*m.path_error_rms_m, 1e-4) << ticks;
    if (ticks > 0) {
      EXPECT_GT(*m.error_others_m, 0.02);
    }
  }
}

TEST(ViewAge, LiesBetweenTicksForAFractionalDelay) {
  const Measures m = Compare(Delayed(0), Delayed(0.1));  // 6.4 ticks
  EXPECT_NEAR(*m.view_age_ms, 100, 2);
  EXPECT_LT(*m.path_error_rms_m, 0.001);
}

TEST(ViewAge, ComesFromTheAngleIfABodyOnlyTurns) {
  BodyPath truth(0, 300), shown(0, 300);
  for (std::int64_t tick = 0; tick <= 300; ++tick) {
    const auto turn = [](double t) { return 0.002 * t * t; };
    truth.Set(tick, DoublePose({5, 5}, turn(static_cast<double>(tick))), true);
    shown.Set(tick, DoublePose({5, 5}, turn(static_cast<double>(tick) - 9)), true);
  }
  const ViewAge age = FitAge(shown, truth, 1, 100, 131, 64);
  EXPECT_TRUE(age.told);
  EXPECT_NEAR(age.ticks, 9, 0.01);
  EXPECT_FALSE(FitAge(shown, truth, 0, 100, 131, 64).told);  // a point does not turn
}

TEST(ViewAge, IsUnknownForStandingOrDisplacedBodies) {
  EXPECT_FALSE(Compare(Moving(0), Moving(0)).view_age_ms);
  const Measures m = Compare(Moving(2), [](std::int64_t tick) {
    BodyState state = Moving(2)(tick);
    state.position.y() += 3;
    return state;
  });
  EXPECT_FALSE(m.view_age_ms);
  EXPECT_NEAR(*m.path_error_rms_m, 3 / std::sqrt(2), 1e-6);  // one of two bodies
}

TEST(Seen, FindsNothingInTheOracleOrItsDelayedView) {
  EXPECT_EQ(Compare(Delayed(0), Delayed(0)).seen, 0);
  EXPECT_EQ(Compare(Delayed(0), Delayed(0.1)).seen, 0);
}

TEST(Seen, FindsNothingInADelayedViewOfABodyThatStops) {
  const auto stopping = [](double delay_s) {
    return [delay_s](std::int64_t tick) {
      const double stop = 150 * kH, s = std::max(0.0, static_cast<double>(tick) * kH - delay_s);
      return State(3 * std::min(s, stop), 0, s < stop ? 3 : 0, 0, 0);
    };
  };
  EXPECT_EQ(Compare(stopping(0), stopping(0.1)).seen, 0);
}

TEST(Seen, IgnoresMillimetresOfNoise) {
  const Path noisy = [](std::int64_t tick) {
    BodyState state = Delayed(0)(tick);
    state.position.x() += tick % 2 == 0 ? 0.002f : -0.002f;
    return state;
  };
  EXPECT_EQ(Compare(Delayed(0), noisy).seen, 0);
}

TEST(Seen, CountsASecondWithAJumpAmongAllSeconds) {
  // 8 seconds of one moving body; a jump of 0.5 m, in the fourth second, back in the same.
  const Measures m = Compare(
      Moving(2),
      [](std::int64_t tick) {
        BodyState state = Moving(2)(tick);
        if (tick >= 210 && tick < 215) state.position.y() += 0.5f;
        return state;
      },
      511);
  EXPECT_DOUBLE_EQ(*m.seen, 1.0 / 8);
}

TEST(Seen, DoesNotCountASecondWithoutMotion) {
  const Path late = [](std::int64_t tick) {
    return State(tick < 256 ? 0 : 2 * kH * static_cast<double>(tick - 256), 1);
  };
  const Measures m = Compare(
      late,
      [&](std::int64_t tick) {
        BodyState state = late(tick);
        if (tick == 270) state.position.y() += 0.5f;
        return state;
      },
      511);
  EXPECT_DOUBLE_EQ(*m.seen, 1.0 / 4);
  EXPECT_FALSE(Compare(Moving(0), Moving(0)).seen);
}

TEST(Seen, TheShareOfVelocityFallsOnAPowerOfTheWindow) {
  EXPECT_DOUBLE_EQ(VelocityShare(kH, kH), 1);
  EXPECT_NEAR(VelocityShare(0.5, kH), 0.07, 1e-12);
  const double middle = std::sqrt(0.5 * kH);
  EXPECT_NEAR(VelocityShare(middle, kH), std::sqrt(0.07), 1e-12);
}

TEST(Seen, FindsAVelocityATenthOffForHalfASecondButNotATwentieth) {
  const auto off = [](double share) {
    return Compare(Moving(4),
                   [share](std::int64_t tick) {
                     const double t = static_cast<double>(tick);
                     return State(4 * kH * (t + share * std::max(0.0, t - 300)), 1, 4, 0);
                   })
        .seen.value();
  };
  EXPECT_GT(off(0.1), 0.2);
  EXPECT_EQ(off(0.05), 0);
}

/// A body, its path shown and true, at 64 Hz.
struct Made {
  Made(const Path& true_path, const Path& shown_path) : truth(0, 256), shown(0, 256) {
    for (std::int64_t tick = 0; tick <= 256; ++tick) {
      truth.Set(tick, DoublePose(true_path(tick)), true);
      shown.Set(tick, DoublePose(shown_path(tick)), true);
    }
    ages.emplace(shown, truth, 0, 64);
  }
  ShownBody Body() const { return {shown, truth, *ages, 0, kH}; }
  BodyPath truth, shown;
  std::optional<ViewAges> ages;
};

TEST(Seen, FindsAStopOfEightyMilliseconds) {
  for (const std::int64_t ticks : {5, 6}) {  // 78 and 94 ms
    const Made made(Moving(2), [ticks](std::int64_t tick) {
      return Moving(2)(tick < 100 || tick >= 100 + ticks ? tick : 99);
    });
    EXPECT_EQ(Stops(made.Body()).empty(), ticks == 5) << ticks;
  }
  const Made standing(Moving(0), Moving(0));
  EXPECT_TRUE(Stops(standing.Body()).empty());
}

TEST(Seen, FindsAKinkThatTheOracleLacks) {
  const auto bent = [](double degrees) -> Path {
    return [degrees](std::int64_t tick) {
      const double s = 2 * kH * static_cast<double>(tick - 128), a = degrees * kPi / 180;
      return s < 0 ? State(s, 0) : State(s * std::cos(a), s * std::sin(a));
    };
  };
  EXPECT_TRUE(Kinks(Made(bent(0), bent(10)).Body()).empty());
  EXPECT_FALSE(Kinks(Made(bent(0), bent(20)).Body()).empty());
  EXPECT_TRUE(Kinks(Made(bent(20), bent(20)).Body()).empty());
}

/// Ball 7 strikes ball 3, which is at rest, at tick 100. The blow moves 3 with `delay` ticks of
/// delay; 7 stands still at once.
Recording Blow(int peers, std::int64_t delay) {
  Recording run = MakeRecording(peers, 255, Moving(0));
  run.room.scene_name = "made";
  run.room.scene_text = kTwoBalls;
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      const auto t = static_cast<double>(tick);
      const double late = peer == 0 ? 0 : static_cast<double>(delay);
      view.x = {static_cast<float>(std::max(0.0, t - 100 - late) * kH * 2),
                static_cast<float>(-1 + std::min(0.0, t - 100) * kH * 2)};
      view.y = {0, 0};
    }
  }
  return run;
}

TEST(Seen, FindsAResponseATenthOfASecondAfterTheOtherBodys) {
  for (const std::int64_t delay : {0, 4, 9}) {  // 0, 63, 141 ms
    const Recording run = Blow(2, delay);
    const Oracle oracle = OracleFromRecording(Blow(1, 0));
    const Measures m = Measure(run, oracle);
    EXPECT_EQ(*m.seen > 0, delay == 9) << delay;
  }
}

TEST(Seen, FindsALinkStretchedByMoreThanThreeHundredths) {
  const std::string jointed = std::string(kTwoBalls) + R"(
[[joint]]
kind = "revolute"
name = "hinge"
a = "three"
b = "seven"
anchor = [-2.5, 0]
)";
  // 3 and 7 each reach 3 m from the hinge: 9 cm are a stretch of 3 %.
  for (const double gap : {0.08, 0.10}) {
    const Path still = [](std::int64_t tick) {
      return State(0, 0, 0, 0, tick % 2 == 0 ? 0 : 0.004);
    };
    Recording run = MakeRecording(2, 255, still), truth = MakeRecording(1, 255, still);
    for (Recording* each : {&run, &truth}) {
      each->room.scene_name = "made";
      each->room.scene_text = jointed;
    }
    for (auto& [tick, view] : run.views[1]) view.x[0] += static_cast<float>(gap);
    EXPECT_EQ(*Measure(run, OracleFromRecording(truth)).seen > 0, gap > 0.09) << gap;
  }
}

Measures Session(const std::string& scene, const std::string& mode, const std::string& impair) {
  ClusterConfig config;
  config.scene = scene;
  config.mode = mode;
  config.impair = impair;
  config.duration_s = 6;
  const Recording recording = RunCluster(config);
  return Measure(recording, ComputeOracle(recording));
}

TEST(Seen, FindsNothingInAnOraclesSession) {
  for (const char* scene : {"crossing", "cradle", "ragdolls"}) {
    const Measures m = Session(scene, "oracle", "perfect");
    EXPECT_EQ(m.seen, 0) << scene;
    EXPECT_EQ(m.error_others_m, 0) << scene;
    EXPECT_EQ(m.path_error_rms_m, 0) << scene;
    EXPECT_EQ(m.energy_ratio_max, 1) << scene;
    EXPECT_EQ(m.energy_ratio_min, 1) << scene;
  }
}

TEST(Seen, FindsTheRubberWall) {
  EXPECT_GT(Session("crossing", "strict", "demo").seen.value(), 0.3);
}

TEST(Kinetic, IsTheRatioOfDisplayedToOracleEnergy) {
  Recording run = Blow(2, 0);
  // Peer 1 shows body 3 at one and a half times its speed, and its physics has it at twice.
  for (auto& [peer, views] : run.views) {
    for (auto& [tick, view] : views) {
      const double v = 2;
      view.x = {static_cast<float>(v * (peer == 1 ? 1.5 : 1) * kH * static_cast<double>(tick)), -5};
      view.vx = {static_cast<float>(peer == 1 ? 2 * v : v), 0};
    }
  }
  Recording truth = run;
  truth.views.erase(1);
  const Measures m = Measure(run, OracleFromRecording(truth));
  EXPECT_NEAR(*m.energy_ratio_min, 1, 1e-5);  // the server
  EXPECT_NEAR(*m.energy_ratio_max, 4, 1e-5);
  EXPECT_NEAR(*m.hottest_ratio, 4, 1e-5);
}

}  // namespace measure_seen_test
}  // namespace seam
