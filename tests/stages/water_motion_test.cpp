/// How bodies move in water, against the equations of motion.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "common/measure/energy.h"
#include "tests/support/water_world.h"

namespace seam {
namespace water_motion_test {

/// The mean period of a body's rising through `level`, s.
double Period(World* world, double level, double seconds) {
  std::optional<double> first, last;
  int periods = 0;
  double before = double{world->Read(0).position.y()} - level;
  for (int i = 0; i * double{world->dt()} < seconds; ++i) {
    world->Step();
    const double now = double{world->Read(0).position.y()} - level;
    if (before < 0 && now >= 0) {
      const double at = (i + before / (before - now)) * double{world->dt()};
      if (first) ++periods;
      if (!first) first = at;
      last = at;
    }
    before = now;
  }
  return periods == 0 ? 0 : (*last - *first) / periods;
}

double BobbingPeriod(int tick_hz) {
  const auto world =
      SmallWorld(Floater("p", "box = [4, 1]\ndensity = 0.5\nposition = [0, 0.1]") + IdealSea(),
                 "tick_hz = " + std::to_string(tick_hz));
  return Period(world.get(), 0, 28);
}

TEST(WaterMotion, ABoxBobsWithThePeriodOfItsDraught) {
  // T = 2 pi sqrt(draught/g), no added mass. The steps lengthen it: sin(w' h/2) = w h/2.
  const double exact = 2 * M_PI * std::sqrt(0.5 / 10);
  EXPECT_NEAR(BobbingPeriod(240), exact, 1e-4 * exact);
  const double omega = 2 * M_PI / exact, h = 1.0 / 60;
  EXPECT_NEAR(BobbingPeriod(60), M_PI * h / std::asin(omega * h / 2), 1e-4 * exact);
}

TEST(WaterMotion, BobbingWithoutDragKeepsItsHeight) {
  const auto world =
      SmallWorld(Floater("p", "box = [4, 1]\ndensity = 0.5\nposition = [0, 0.1]") + IdealSea());
  float highest = 0;
  Steps(world.get(), 60 * 60);
  for (int i = 0; i < 120; ++i) {
    world->Step();
    highest = std::max(highest, world->Read(0).position.y());
  }
  EXPECT_NEAR(highest, 0.1, 0.003);
}

TEST(WaterMotion, EnergyWithTheWatersIsKeptWhileBodiesBobAndRock) {
  const auto world = SmallWorld(
      Floater("p",
              "polygon = [[-1, -0.4], [0.8, -0.6], [1.2, 0.2], [0, 0.8]]\ndensity = 0.6\n"
              "position = [0, 0.4]\nangle = 0.5") +
          IdealSea(),
      "tick_hz = 480");
  const EnergyMeter meter(world->scene(), world->composition());
  const double start = meter.Of({world->Read(0)});
  double off = 0, low = world->Energy(), high = low;
  for (int i = 0; i < 480 * 10; ++i) {
    world->Step();
    off = std::max(off, std::fabs(meter.Of({world->Read(0)}) - start));
    low = std::min(low, world->Energy());
    high = std::max(high, world->Energy());
  }
  EXPECT_GT(high - low, 2) << "J, to and fro between the thing and the water";
  EXPECT_LT(off, 0.01 * (high - low));
}

TEST(WaterMotion, ASinkingBoxReachesItsTerminalSpeedAsTanh) {
  for (const int tick_hz : {60, 240}) {
    const auto world = SmallWorld(Floater("p", "box = [1, 2]\ndensity = 3\nposition = [0, -2]") +
                                      Sea("viscosity = 0\ndrag_tangent = 0"),
                                  "tick_hz = " + std::to_string(tick_hz));
    // 6 kg, of which 2 are lifted; rho/2 C width = 1/2.
    const double fall = 10 * 4.0 / 6, limit = std::sqrt(40 / 0.5);
    for (int i = 1; i <= 4 * tick_hz; ++i) {
      world->Step();
      const double t = static_cast<double>(i) / tick_hz;
      ASSERT_NEAR(-world->Read(0).velocity.y(), limit * std::tanh(fall * t / limit), 1.5 / tick_hz)
          << t;
    }
  }
}

TEST(WaterMotion, TerminalSpeedIsExactEvenWhereExplicitDragExplodes) {
  // A plank with vt = 0.24 m/s and g = 20 m/s^2: explicit drag needs steps below 12 ms.
  const auto world = SmallWorld(Floater("p", "box = [10, 0.05]\ndensity = 3\nposition = [0, -2]") +
                                    Sea("viscosity = 0\ndrag_tangent = 0\ndrag_normal = 100"),
                                "tick_hz = 10", "gravity = [0, -30]");
  const double limit = std::sqrt(0.05 * 10 * 2 * 30 / (0.5 * 100 * 10));
  double before = 0;
  for (int i = 0; i < 100; ++i) {
    world->Step();
    // From rest there is no drag to look ahead by: the first step falls freely.
    const double most = i == 0 ? 20.0 / 60 : before;
    ASSERT_LE(-double{world->Read(0).velocity.y()}, most * 1.0001);
    ASSERT_LE(world->Read(0).velocity.y(), 0);
    before = -double{world->Read(0).velocity.y()};
  }
  EXPECT_NEAR(-world->Read(0).velocity.y(), limit, 1e-4 * limit);
}

TEST(WaterMotion, ViscosityAloneSlowsByTheExponential) {
  const auto world = SmallWorld(
      Floater("p", "circle = 0.5\ndensity = 1\nposition = [0, -9]\nvelocity = [4, 0]\nspin = 3") +
          Sea("viscosity = 0.7\ndrag_tangent = 0\ndrag_normal = 0"),
      "tick_hz = 240");
  Steps(world.get(), 480);
  const double left = std::exp(-0.7 * 2);
  EXPECT_NEAR(world->Read(0).velocity.x(), 4 * left, 0.01 * 4 * left);
  EXPECT_NEAR(world->Read(0).spin, 3 * left, 0.01 * 3 * left);
}

TEST(WaterMotion, ASpinningDiscIsSlowedByFrictionAlone) {
  // I w' = -rho/2 C 2 pi r (w r)^2 r and I = rho pi r^4/2: w = w0/(1 + 2 C w0 t).
  const auto world =
      SmallWorld(Floater("p", "circle = 0.5\ndensity = 1\nposition = [0, -9]\nspin = 8") +
                     Sea("viscosity = 0\ndrag_tangent = 0.1\ndrag_normal = 1"),
                 "tick_hz = 240");
  Steps(world.get(), 480);
  EXPECT_NEAR(world->Read(0).spin, 8 / (1 + 2 * 0.1 * 8 * 2), 0.02);
}

TEST(WaterMotion, ASpinningPlankIsSlowedByItsLeadingHalves) {
  // One half of each long side leads: the torque is 2 rho/2 C w^2 a^4/4 with a half the length. The
  // short sides add a little (a thickness of 1/40 to the fourth).
  const auto world =
      SmallWorld(Floater("p", "box = [4, 0.1]\ndensity = 1\nposition = [0, -9]\nspin = 3") +
                     Sea("viscosity = 0\ndrag_tangent = 0\ndrag_normal = 1"),
                 "tick_hz = 240");
  const double inertia = 0.4 * (16 + 0.01) / 12, factor = 16.0 / 4 / inertia;
  Steps(world.get(), 480);
  EXPECT_NEAR(world->Read(0).spin, 3 / (1 + factor * 3 * 2), 0.002);
}

TEST(WaterMotion, AFlowCarriesAFloater) {
  const auto world =
      SmallWorld(Floater("p", "box = [1, 1]\ndensity = 0.5") + Sea("flow = [1.5, 0]"));
  Steps(world.get(), 60 * 20);
  EXPECT_NEAR(world->Read(0).velocity.x(), 1.5, 0.01);
  EXPECT_GT(world->Read(0).position.x(), 15);
}

TEST(WaterMotion, TheCrossSectionSlowsAndTheLongSideDoesNot) {
  const auto speed = [](const char* box) {
    const auto world = SmallWorld(
        Floater("p", std::string(box) + "\ndensity = 1\nposition = [0, -9]\nvelocity = [5, 0]") +
        Sea("viscosity = 0"));
    Steps(world.get(), 60);
    return world->Read(0).velocity.x();
  };
  // v = v0/(1 + k v0 t/m), k = rho/2 (C_n 0.5 + C_t 8) along and rho/2 (C_n 4 + C_t 1) across.
  EXPECT_NEAR(speed("box = [4, 0.5]"), 5 / (1 + 0.45 * 5 / 2), 0.03);
  EXPECT_NEAR(speed("box = [0.5, 4]"), 5 / (1 + 2.025 * 5 / 2), 0.03);
}

TEST(WaterMotion, EnergyNeverGrowsInStillWater) {
  // A lump of odd shape thrown in with spin: with gravity, buoyancy's potential would be needed, so
  // without it.
  const auto world = SmallWorld(
      Floater("p",
              "polygon = [[-1, -0.3], [0.8, -0.5], [1.2, 0.1], [0, 0.9]]\nvelocity = [20, -3]"
              "\nspin = 30\nposition = [0, -9]") +
          Sea("drag_normal = 50\ndrag_tangent = 5"),
      "tick_hz = 30", "gravity = [0, 0]");
  double before = world->Energy();
  for (int i = 0; i < 200; ++i) {
    world->Step();
    ASSERT_LE(world->Energy(), before * (1 + 1e-6)) << i;
    before = world->Energy();
  }
  EXPECT_LT(before, 1);
}

}  // namespace water_motion_test
}  // namespace seam
