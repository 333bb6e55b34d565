/// A load on a taut bridge gets no energy but that of its fall, and the joints stay closed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "tests/physics/exact/exact_scenes.h"
#include "tests/support/mechanisms/taut_bridge.h"

namespace seam {
namespace exact_bridge_test {

/// Shares of the energy released by the fall that may be gained: the bar.
constexpr double kGainMost = 0.02;
/// m: joints of 60 planks; and of 100, whose ends are 50 m from the origin, where single precision
/// is 4e-6 m.
constexpr double kGapMost = 1.2e-5, kLongGapMost = 3e-5;

void ExpectCalm(World* world, double gap, const std::string& name) {
  const BridgeCourse course = FollowBridge(world, 2);
  EXPECT_LE(course.gained, kGainMost * course.released) << name;
  EXPECT_LT(course.gap, gap) << name;
  EXPECT_LT(course.fastest, 6) << name << ": no more than a fall of a metre, and the bridge's own";
  EXPECT_GT(course.lowest, -0.3) << name << ": the bridge holds";
}

TEST(ExactBridge, ALoadOnATautBridgeGetsNoEnergyButItsFall) {
  for (const int planks : {10, 60, 100}) {
    for (const double load : {1.0, 40.0, 100.0}) {
      for (const double drop : {0.0, 0.03, 1.0}) {
        for (const int substeps : {1, 2, 3, 6}) {
          TautBridge bridge;
          bridge.planks = planks;
          bridge.load = load;
          bridge.drop = drop;
          bridge.substeps = substeps;
          ExpectCalm(
              TautBridgeWorld(bridge).get(), planks > 60 ? kLongGapMost : kGapMost,
              fmt::format("{} planks, {} kg from {} m, {} substeps", planks, load, drop, substeps));
        }
      }
    }
  }
}

TEST(ExactBridge, ALoadComesToRestOnATautBridge) {
  const auto world = TautBridgeWorld({});
  Steps(world.get(), 300);
  // The load is the last body.
  const BodyState load = world->Read(world->body_count() - 1);
  EXPECT_LT(load.velocity.norm(), 0.02);
  EXPECT_NEAR(load.position.y(), 1.11, 0.01) << "straight: hardly below where it touched";
}

TEST(ExactBridge, OtherPlanksRatesAndLoadsGetNoEnergyEither) {
  const auto ball = [](double x, double y, double density) {
    return PartText("ball" + std::to_string(static_cast<int>(x)),
                    "circle = 0.6\nposition = [" + FloatDigits(x) + ", " + FloatDigits(y) +
                        "]\ndensity = " + FloatDigits(density) + "\nvelocity = [1, 0]");
  };
  for (const char* rate : {"tick_hz = 30\n", "tick_hz = 120\n"}) {
    for (const double density : {0.3, 3.0}) {
      for (const int planks : {20, 45}) {
        TautBridge bridge;
        bridge.planks = planks;
        bridge.plank_density = density;
        bridge.load = 15;
        bridge.solver = rate;
        bridge.more = ball(-6, 1.2, 4) + ball(5, 1.5, 25);
        ExpectCalm(TautBridgeWorld(bridge).get(), kGapMost,
                   fmt::format("{} planks of {} kg/m2, {}", planks, density, rate));
      }
    }
  }
}

/// Links of some 0.15 kg, hinged to a ring that falls onto the ground with a block of 30 to 80 kg
/// in it: more contacts than are solved as a whole.
std::string LoadedRing(int links, double radius, double density) {
  std::string text = PartText("ground", "segment = [[-60, 0], [60, 0]]\nfriction = 0.8");
  const auto at = [&](double index, double r) {
    const double angle = 2 * M_PI * index / links;
    return std::pair(r * std::cos(angle), radius + 1 + r * std::sin(angle));
  };
  const double side = 2 * radius * std::sin(M_PI / links);
  for (int i = 0; i < links; ++i) {
    const auto [x, y] = at(i + 0.5, radius * std::cos(M_PI / links));
    text += PartText("link" + std::to_string(i),
                     fmt::format("box = [{:.6f}, 0.15]\nposition = [{:.6f}, {:.6f}]\n"
                                 "angle = {:.6f}\nfriction = 0.6\ngroup = -1",
                                 side, x, y, 2 * M_PI * (i + 0.5) / links + M_PI / 2));
  }
  for (int i = 0; i < links; ++i) {
    const auto [x, y] = at(i, radius);
    text += HingeText("pin" + std::to_string(i), "link" + std::to_string((i + links - 1) % links),
                      "link" + std::to_string(i), x, y);
  }
  return text + PartText("load", fmt::format("box = [2, 2]\nposition = [0.3, {:.6f}]\n"
                                             "density = {}\nfriction = 0.6",
                                             radius - 1, density));
}

TEST(ExactBridge, ARingOfLightLinksHoldsTheBlockInIt) {
  for (const int links : {20, 24, 31}) {
    for (const double density : {8.0, 20.0}) {
      for (const char* substeps : {"1", "2", "5"}) {
        const auto world = SmallWorld(LoadedRing(links, links / 6.0, density),
                                      std::string("joint_substeps = ") + substeps + "\n");
        const BridgeCourse course = FollowBridge(world.get(), 5);
        const std::string name = fmt::format("{} links, {}, {} substeps", links, density, substeps);
        EXPECT_LE(course.gained, kGainMost * course.released) << name;
        EXPECT_LT(course.gap, kLongGapMost) << name;
      }
    }
  }
}

}  // namespace exact_bridge_test
}  // namespace seam
