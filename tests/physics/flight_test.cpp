/// Bodies simulated elsewhere fall and bounce as in the engine.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "common/physics/world.h"

namespace seam {
namespace flight_test {

/// A body over ground. {} is the part, followed by its obstacles.
World WorldOf(const std::string& text) { return World(ParseScene(text, "flight.toml")); }

std::string Ball(const std::string& more) {
  return "[[part]]\nname = \"ball\"\ncircle = 0.4\n" + more;
}

constexpr const char* kFloor =
    "[[part]]\nname = \"floor\"\nbox = [60, 2]\nposition = [0, -1]\nanchored = true\n";

/// Largest distance of body 0 from the engine's simulation, in `ticks`, m.
float OffFromEngine(World* world, int ticks, int every) {
  BodyState at = world->Read(0);
  float off = 0;
  for (int tick = 1; tick <= ticks; ++tick) {
    world->Step();
    if (tick % every != 0) continue;
    at = world->AfterFlight(0, at, static_cast<float>(every) * world->dt());
    off = std::max(off, (at.position - world->Read(0).position).norm());
  }
  return off;
}

TEST(Flight, FallsAsTheEngineDoesWithAnySubsteps) {
  for (const char* solver : {"", "[solver]\nsubsteps = 2\n", "[solver]\nsubsteps = 5\n"}) {
    World world = WorldOf(Ball("position = [0, 40]\nvelocity = [3, 5]\n") + solver);
    EXPECT_LT(OffFromEngine(&world, 120, 1), 1e-3f) << solver;
    World seldom = WorldOf(Ball("position = [0, 40]\nvelocity = [3, 5]\n") + solver);
    EXPECT_LT(OffFromEngine(&seldom, 120, 30), 1e-3f) << solver;
  }
}

TEST(Flight, BouncesOffFloorsWallsAndLinesFromTheirSolidSide) {
  const std::string thrown =
      "position = [0, 3]\nvelocity = [4, 0]\nrestitution = 0.8\nfriction = 0\n";
  World floor = WorldOf(Ball(thrown) + kFloor);
  EXPECT_LT(OffFromEngine(&floor, 60, 6), 0.1f) << "to the first bounce";
  World line = WorldOf(Ball(thrown) +
                       "[[part]]\nname = \"line\"\nchain = [[-30, 0], [30, 0]]\nfriction = 0.5\n");
  EXPECT_LT(OffFromEngine(&line, 60, 6), 0.1f);
  // From below the same line is open. The engine pushes out overlapping bodies once the centre is
  // through, which is no flight.
  World below = WorldOf(Ball("position = [0, -3]\nvelocity = [0, 12]\n") +
                        "[[part]]\nname = \"line\"\nchain = [[-30, 0], [30, 0]]\n");
  EXPECT_LT(OffFromEngine(&below, 60, 6), 0.4f);
  EXPECT_GT(below.Read(0).position.y(), 3);
  World corner =
      WorldOf(Ball("position = [0, 3]\nvelocity = [9, 0]\nrestitution = 0.5\n") + kFloor +
              "[[part]]\nname = \"wall\"\nbox = [1, 20]\nposition = [4, 9]\nanchored = "
              "true\n");
  BodyState at = corner.AfterFlight(0, corner.Read(0), 2);
  EXPECT_LT(at.position.x(), 3.12f);
  EXPECT_GT(at.position.y(), 0.37f);
}

/// Boxes that tumble land where the engine's do, roughly, and never in the floor or behind it.
TEST(Flight, ThrownBodiesStayOutsideAnchoredBodies) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> drawn(-1, 1);
  const std::string room =
      std::string(kFloor) +
      "[[part]]\nname = \"left\"\nbox = [2, 40]\nposition = [-11, 19]\nanchored "
      "= true\n[[part]]\nname = \"right\"\nbox = [2, 40]\nposition = [11, 19]\n"
      "anchored = true\n[[part]]\nname = \"slope\"\npolygon = [[-4, 0], [4, 0], "
      "[4, 3]]\nposition = [5, 0]\nanchored = true\n";
  int bounced = 0;
  for (const char* shape : {"box = [1, 0.6]", "circle = 0.5", "capsule = [1.2, 0.3]",
                            "polygon = [[-0.6, -0.4], [0.6, -0.4], [0, 0.7]]"}) {
    World world = WorldOf("[[part]]\nname = \"it\"\n" + std::string(shape) +
                          "\nposition = [0, 5]\nrestitution = 0.6\n" + room);
    for (int draw = 0; draw < 100; ++draw) {
      BodyState at = world.Read(0);
      at.velocity = Vec2(15 * drawn(random), 8 * drawn(random));
      at.spin = 6 * drawn(random);
      at.angle = 3 * drawn(random);
      for (int leg = 0; leg < 40; ++leg) {
        const float fell = at.velocity.y();
        at = world.AfterFlight(0, at, 0.05f);
        bounced += at.velocity.y() > fell + 0.1f ? 1 : 0;
        ASSERT_TRUE(at.position.allFinite() && at.velocity.allFinite() && std::isfinite(at.spin));
        EXPECT_GT(at.position.y(), 0.1f) << shape << " " << draw;
        EXPECT_LT(std::fabs(at.position.x()), 9.95f) << shape << " " << draw;
        EXPECT_LT(at.velocity.norm(), 60) << shape << " " << draw;
      }
    }
  }
  EXPECT_GT(bounced, 400);
}

TEST(Flight, ABodyThatDoesNotBounceComesToRest) {
  World world = WorldOf("[[part]]\nname = \"it\"\nbox = [1, 1]\nposition = [0, 2]\nfriction = 1\n" +
                        std::string(kFloor));
  const BodyState at = world.AfterFlight(0, world.Read(0), 2);
  EXPECT_NEAR(at.position.y(), 0.5f, 0.03f);
  EXPECT_LT(at.velocity.norm(), 0.05f);
}

TEST(Flight, PassesThroughFilteredAndMovingBodies) {
  World through = WorldOf(Ball("position = [0, 3]\ngroup = -2\n") + kFloor + "group = -2\n" +
                          "[[part]]\nname = \"other\"\nbox = [4, 1]\nposition = [0, 1]\n");
  EXPECT_LT(through.AfterFlight(0, through.Read(0), 1.5f).position.y(), -5);
}

}  // namespace flight_test
}  // namespace seam
