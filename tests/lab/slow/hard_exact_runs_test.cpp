/// Runs the hard cases with an answer: the scene's own setting against the stock one, and small
/// steps.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lab/hard/hard_case.h"
#include "tests/support/hard_case_named.h"

namespace seam {
namespace hard_exact_runs_test {

struct Verdict {
  double error;
  std::string failure;
};

Verdict Judged(const HardCase& hard, const Scene& scene) {
  World world(scene);
  const std::unique_ptr<Judge> judge = hard.judge(scene);
  judge->See(world);
  const long ticks = std::lround(hard.seconds * scene.solver.tick_hz);
  for (long n = 0; n < ticks; ++n) {
    world.Step();
    judge->See(world);
  }
  return {judge->Error(), judge->Failure()};
}

Verdict RunStock(const HardCase& hard) {
  Scene scene = LoadHardScene(hard);
  scene.solver = StockSolver();
  return Judged(hard, scene);
}

/// 960 Hz with `substeps` of 8/3, in all else as the scene has it.
Verdict RunFinely(const HardCase& hard, int substeps) {
  Scene scene = LoadHardScene(hard);
  scene.solver.tick_hz = 960;
  scene.solver.substeps = substeps;
  scene.solver.velocity_iterations = 8;
  scene.solver.position_iterations = 3;
  return Judged(hard, scene);
}

/// Twice the measured error, in the case's unit.
struct Bound {
  const char* name;
  double own, fine;  ///< the scene's own setting; 960 Hz, two substeps of 8/3
};

const Bound kBounds[] = {
    {"cantilever", 1e-5, 1e-5},
    {"catenary", 3.5e-4, 6.5e-5},
    {"chain-heavy-end", 0.026, 0.0133},
    {"collision-elastic", 5e-7, 5e-7},
    {"collision-glancing", 0.097, 0.0029},
    {"collision-inelastic", 5e-7, 5e-7},
    {"cradle-gaps", 0.037, 0.0015},
    {"motor-loop", 0.029, 0.0019},
    {"pendulum-double", 0.88, 0.89},
    {"pendulum-energy", 0.39, 0.39},
    {"pendulum-period", 0.0026, 0.0026},
    {"projectile", 6e-5, 0.0055},  // 1920 roundings a second
    {"projectile-parabola", 0.67, 0.023},
    {"rocking-spin", 0.18, 0.21},  // the engine's slop of 5 mm
    {"rocking-spin-tenfold", 0.021, 0.019},
    {"rocking-time", 0.012, 0.0089},
    {"rocking-time-tenfold", 0.01, 2.5e-4},
    {"rolling-disc", 0.039, 0.005},
    {"rolling-disc-slip", 5.1e-5, 1.4e-4},
    {"slide-flat", 0.134, 0.0037},
    {"slope-creep", 2.3e-7, 1e-6},
    {"slope-slide", 0.137, 0.0063},
    {"slope-stop", 0.134, 0.0045},
};

TEST(HardExactRuns, TheScenesOwnSettingKeepsItsMeasuredBounds) {
  for (const Bound& bound : kBounds) {
    const Verdict own = Judged(CaseNamed(bound.name), LoadHardScene(CaseNamed(bound.name)));
    EXPECT_LE(own.error, bound.own) << bound.name;
    EXPECT_EQ(own.failure, "") << bound.name;
  }
}

TEST(HardExactRuns, TheScenesOwnSettingIsNoWorseThanStock) {
  for (const HardCase& hard : ExactCases()) {
    if (!hard.judge) continue;
    // There the engine's slop and its skin happen to take each other away.
    if (hard.name == "rocking-spin-tenfold") continue;
    const double own = Judged(hard, LoadHardScene(hard)).error;
    EXPECT_LE(own, RunStock(hard).error * 1.001) << hard.name;
  }
}

TEST(HardExactRuns, SmallStepsConvergeToTheFormulas) {
  // So the formulas describe the scenes, and the remaining error is the step's.
  for (const Bound& bound : kBounds) {
    EXPECT_LE(RunFinely(CaseNamed(bound.name), 2).error, bound.fine) << bound.name;
  }
  EXPECT_LE(RunFinely(CaseNamed("pendulum-energy"), 8).error, 0.12);
}

TEST(HardExactRuns, JudgesAreRightAtAnyRate) {
  // At 30 ticks a second the step's share of these is twice that of stock, and at 960 a sixteenth,
  // however a tick is cut.
  for (const char* name : {"projectile-parabola", "slide-flat", "slope-slide", "slope-stop"}) {
    const HardCase& hard = CaseNamed(name);
    const double stock = RunStock(hard).error;
    for (const int hz : {30, 120, 480, 960}) {
      for (const int substeps : {1, 3}) {
        Scene scene = LoadHardScene(hard);
        scene.solver = StockSolver();
        scene.solver.tick_hz = hz;
        scene.solver.substeps = substeps;
        EXPECT_NEAR(Judged(hard, scene).error / stock, 60.0 / (hz * substeps), 0.05)
            << name << " " << hz << " " << substeps;
      }
    }
  }
}

TEST(HardExactRuns, NothingTunnelsOrIsSlowedWithTheCasesOwnSteps) {
  int shots = 0;
  for (const HardCase& hard : ExactCases()) {
    if (hard.scene != "tunnel") continue;
    ++shots;
    const Verdict own = Judged(hard, LoadHardScene(hard));
    EXPECT_EQ(own.error, 0) << hard.name;
    EXPECT_EQ(own.failure, "") << hard.name;
  }
  EXPECT_EQ(shots, 16);
  // And stock: half of all shots pass, which is every one at a wall that moves; above 120 m/s the
  // clamp slows them all.
  EXPECT_GT(RunStock(CaseNamed("tunnel-plain-0100")).error, 0.4);
  EXPECT_EQ(RunStock(CaseNamed("tunnel-bullet-0120")).failure, "");
  EXPECT_EQ(RunStock(CaseNamed("tunnel-bullet-0200")).failure,
            "32 of 32 shots slowed by the engine's clamp");
}

TEST(HardExactRuns, StockErrsByMetresInFiveCases) {
  EXPECT_GT(RunStock(CaseNamed("cantilever")).error, 2);         // m of 10 m
  EXPECT_GT(RunStock(CaseNamed("chain-heavy-end")).error, 5);    // m of 10 m
  EXPECT_GT(RunStock(CaseNamed("motor-loop")).error, 3);         // rad of 60
  EXPECT_GT(RunStock(CaseNamed("pendulum-energy")).error, 0.8);  // of all there is
  // Balls that touch are struck one after the other within a step; exact joints know that.
  EXPECT_GT(RunStock(CaseNamed("cradle-touching")).error, 0.5);
  EXPECT_LT(RunFinely(CaseNamed("cradle-touching"), 2).error, 1e-3);
}

/// m/s between the dominoes 10 and 25, which pass 0.25 rad one after the other.
double WaveSpeed(int tick_hz, int substeps) {
  Scene scene = LoadHardScene(CaseNamed("dominoes"));
  scene.solver.tick_hz = tick_hz;
  scene.solver.substeps = substeps;
  World world(scene);
  const auto lean = [&](int domino) { return -static_cast<double>(world.Read(domino).angle); };
  double passed[2] = {0, 0};
  double before[2] = {0, 0};
  for (int n = 1; n <= 6 * tick_hz; ++n) {
    world.Step();
    for (int k = 0; k < 2; ++k) {
      const double now = lean(k == 0 ? 10 : 25);
      if (passed[k] <= 0 && now > 0.25) {
        passed[k] = (n - 1 + (0.25 - before[k]) / (now - before[k])) / tick_hz;
      }
      before[k] = now;
    }
  }
  return 15 * 0.5 / (passed[1] - passed[0]);
}

TEST(HardExactRuns, TheDominoWaveHasOneSpeedAndTheSceneNearlyReachesIt) {
  // In units of sqrt(g H), by which domino waves scale (McLachlan et al. 1983). Measured 0.997 with
  // small steps, 0.993 with the scene's.
  const double fine = WaveSpeed(960, 2);
  EXPECT_NEAR(WaveSpeed(480, 2) / fine, 1, 0.002);
  EXPECT_NEAR(fine / std::sqrt(10.0), 0.997, 0.005);
  EXPECT_NEAR(WaveSpeed(60, 2) / fine, 1, 0.008);
}

}  // namespace hard_exact_runs_test
}  // namespace seam
