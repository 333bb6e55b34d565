/// Hand-over between the engine and the exact solver: impacts of continuous collision, impulses of
/// taut joints, joints that return open.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/base/random.h"
#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace exact_handed_test {

double Fastest(const World& world) {
  double most = 0;
  for (int body = 0; body < world.body_count(); ++body) {
    most = std::max(most, static_cast<double>(world.Read(body).velocity.norm()));
  }
  return most;
}

/// m/s: the most that anything has within so many ticks.
double FastestWithin(World* world, int ticks) {
  double most = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    world->Step();
    most = std::max(most, Fastest(*world));
  }
  return most;
}

/// A box and a disc, jointed, that fall by 2 m onto a floor which gives everything back.
std::string BouncingPair(const std::string& joint, double restitution, double turned) {
  const std::string gives = "restitution = " + FloatDigits(restitution) + "\nfriction = 0";
  return "[[part]]\nname = \"floor\"\nsegment = [[-30, 0], [30, 0]]\n" + gives + "\n" +
         PartText("a", "box = [0.8, 0.3]\nposition = [-0.9, 2]\nangle = " + FloatDigits(turned) +
                           "\n" + gives) +
         PartText("b", "circle = 0.35\nposition = [0, 2]\ndensity = 5\n" + gives) +
         "[[joint]]\nname = \"j\"\na = \"a\"\nb = \"b\"\n" + joint + "\n";
}

TEST(ExactHandedToEngine, ContinuousCollisionAddsNoSpeedToBouncingBodies) {
  const char* const joints[] = {
      "kind = \"distance\"\nfrequency = 3\ndamping_ratio = 0", "kind = \"distance\"",
      "kind = \"hinge\"\nanchor = [-0.45, 2]", "kind = \"rope\"\nlength = 1.2",
      "kind = \"weld\"\nanchor = [-0.45, 2]\nfrequency = 4\ndamping_ratio = 0.1"};
  for (const char* joint : joints) {
    for (const double restitution : {0.8, 0.9, 1.0}) {
      for (const double turned : {0.0, 0.4, -1.1}) {
        const auto world =
            SmallWorld(BouncingPair(joint, restitution, turned), "continuous = true\n");
        // It falls by 2 m: 6.3 m/s. A light box on a heavy disc may be thrown at three times that.
        EXPECT_LT(FastestWithin(world.get(), 900), 20)
            << joint << " " << restitution << " " << turned;
      }
    }
  }
}

/// Planks hinged between two cliffs, flat, so that they are as taut as can be, and crates on them:
/// more than is solved as a whole.
std::string FlatBridge(int planks, int crates) {
  std::string text = PartText("left", "box = [4, 8]\nposition = [-2, -4]\nanchored = true") +
                     PartText("right", "box = [4, 8]\nposition = [" + FloatDigits(planks + 2.0) +
                                           ", -4]\nanchored = true") +
                     ChainText(planks, 0, -0.11, "density = 1.5\nfriction = 0.8");
  text += HingeText("first", "left", "link.0", 0, -0.11) +
          HingeText("last", "link." + std::to_string(planks - 1), "right", planks, -0.11);
  return text + PartText("crate",
                         "box = [0.8, 0.8]\nposition = [2, 0.41]\nfriction = 0.6\n"
                         "repeat = {count = [" +
                             std::to_string(crates) + ", 4], step = [0.82, 0.82]}");
}

TEST(ExactHandedToEngine, ATautBridgeBeginsWithoutWarmImpulsesInTheEngine) {
  for (const int planks : {16, 20, 24}) {
    const auto world = SmallWorld(FlatBridge(planks, planks - 5));
    // Nothing falls by more than a few metres.
    EXPECT_LT(FastestWithin(world.get(), 240), 20) << planks;
  }
}

TEST(ExactHandedToEngine, ALightChainThatReturnsOpenIsClosedNotThrown) {
  // Almost straight, between an anchor and a heavy load: nearly singular.
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const auto world = ExactWorld(
        PostText(0, 0) + ChainText(10, 0, 0, "density = 0.5") +
            PartText("load", "box = [2, 2]\nposition = [11, 0]\ndensity = 12") +
            HingeText("top", "post", "link.0", 0, 0) + HingeText("hook", "link.9", "load", 10, 0),
        "", "gravity = [0, 0]");
    std::vector<BodyState> before = StatesOf(*world);
    for (int body = 0; body < world->body_count(); ++body) {
      BodyState& state = before[static_cast<std::size_t>(body)];
      // The engine has left it stretched by half a metre.
      state.position.x() *= 1.05f;
      state.position.y() += static_cast<float>(random.Uniform(-0.02, 0.02));
      state.angle += static_cast<float>(random.Uniform(-0.03, 0.03));
      world->Write(body, state);
    }
    world->Step();
    EXPECT_LT(Drift(*world), 1e-3) << i;
    EXPECT_LT(Fastest(*world), 1) << i << ": no velocity comes of it";
    for (int body = 0; body < world->body_count(); ++body) {
      const BodyState now = world->Read(body);
      const BodyState& then = before[static_cast<std::size_t>(body)];
      EXPECT_LT((now.position - then.position).norm(), 0.7) << i << " " << body;
      EXPECT_LT(std::fabs(now.angle - then.angle), 0.8) << i << " " << body;
    }
  }
}

}  // namespace exact_handed_test
}  // namespace seam
