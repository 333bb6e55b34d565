/// World::begun_touches: each touch of two parts once, however brief, with barriers and without.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "common/physics/world.h"

namespace seam {
namespace touch_log_test {

/// A ball that bounces between four walls without loss.
std::string Bouncing(int substeps) {
  std::string text = "gravity = [0, 0]\n[solver]\nsubsteps = " + std::to_string(substeps) + "\n";
  const char* const walls[] = {
      "box = [1, 20]\nposition = [-8, 0]", "box = [1, 20]\nposition = [8, 0]",
      "box = [20, 1]\nposition = [0, -5]", "box = [20, 1]\nposition = [0, 5]"};
  for (int i = 0; i < 4; ++i) {
    text += "[[part]]\nname = \"w" + std::to_string(i) + "\"\n" + walls[i] +
            "\nanchored = true\nrestitution = 1\nfriction = 0\n";
  }
  return text +
         "[[part]]\nname = \"ball\"\ncircle = 0.5\nvelocity = [7.3, 2.9]\n"
         "restitution = 1\nfriction = 0\n";
}

constexpr PartId kBall = 4;

/// Touches of the ball by wall; and reversals of its velocity, which must be as many.
struct Bounces {
  std::map<PartId, int> told;
  int all = 0, reversals = 0;
};

void Step(World* world, Bounces* bounces) {
  const Vec2 before = world->Read(0).velocity;
  world->Step();
  const Vec2 after = world->Read(0).velocity;
  bounces->reversals += static_cast<int>((before.array() * after.array() < 0).count());
  for (const PartTouch& touch : world->begun_touches()) {
    EXPECT_EQ(touch.b, kBall);
    ++bounces->told[touch.a];
    ++bounces->all;
  }
}

TEST(TouchLog, EveryBounceIsToldOnceWithBarriersAndWithout) {
  for (const int substeps : {1, 3}) {
    for (const int every : {0, 1, 2, 3, 6}) {
      SCOPED_TRACE(std::to_string(substeps) + " substeps, a barrier every " +
                   std::to_string(every));
      World world(ParseScene(Bouncing(substeps), "walls.toml"));
      world.WatchTouches();
      Bounces bounces;
      for (int tick = 1; tick <= 3600; ++tick) {
        Step(&world, &bounces);
        if (every > 0 && tick % every == 0) world.Barrier();
      }
      EXPECT_GT(bounces.reversals, 40);
      EXPECT_EQ(bounces.all, bounces.reversals);
      EXPECT_EQ(bounces.told.size(), 4u);
    }
  }
}

TEST(TouchLog, ATickThatIsSteppedAgainHasTheSameTouches) {
  World world(ParseScene(Bouncing(2), "walls.toml"));
  world.WatchTouches();
  for (int round = 0; round < 60; ++round) {
    const WorldSnapshot then = world.Barrier();
    std::vector<std::vector<PartTouch>> first;
    for (int i = 0; i < 7; ++i) {
      world.Step();
      first.push_back(world.begun_touches());
    }
    ASSERT_TRUE(world.Restore(then).ok());
    for (int i = 0; i < 7; ++i) {
      world.Step();
      EXPECT_TRUE(world.begun_touches() == first[static_cast<std::size_t>(i)]) << world.tick();
    }
  }
}

TEST(TouchLog, PartsThatStayInTouchAreToldOnce) {
  // A wheel rolls over the 40 segments of one part; a box and a capsule of three shapes lie on it.
  std::string points;
  for (int i = 0; i <= 40; ++i) points += (i > 0 ? ", [" : "[") + std::to_string(-20 + i) + ", 0]";
  World world(
      ParseScene("[[part]]\nname = \"ground\"\nchain = [" + points +
                     "]\n[[part]]\nname = \"wheel\"\ncircle = 0.5\nposition = [-10, 0.51]\n"
                     "velocity = [4, 0]\n"
                     "[[part]]\nname = \"box\"\nbox = [3, 0.5]\nposition = [12, 0.26]\n"
                     "[[part]]\nname = \"pill\"\ncapsule = [2, 0.3]\nposition = [16, 0.31]\n",
                 "chain.toml"));
  world.WatchTouches();
  std::map<PartId, int> told;
  for (int tick = 1; tick <= 240; ++tick) {
    world.Step();
    for (const PartTouch& touch : world.begun_touches()) {
      EXPECT_EQ(touch.a, 0);
      ++told[touch.b];
    }
    if (tick % 2 == 0) world.Barrier();
  }
  EXPECT_GT(world.Read(0).position.x(), 0) << "over ten segments";
  EXPECT_EQ(told, (std::map<PartId, int>{{1, 1}, {2, 1}, {3, 1}}));
}

TEST(TouchLog, EachOfManyMergedTilesIsToldWhenTheBallRollsOntoIt) {
  World world(
      ParseScene("[[part]]\nname = \"tile\"\nbox = [1, 1]\nposition = [-20, -0.5]\n"
                 "anchored = true\nrepeat = {count = 40, step = [1, 0]}\n"
                 "[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [-10, 0.51]\n"
                 "velocity = [6, 0]\n",
                 "tiles.toml"));
  world.WatchTouches();
  std::map<PartId, int> told;
  for (int tick = 1; tick <= 120; ++tick) {
    world.Step();
    for (const PartTouch& touch : world.begun_touches()) ++told[touch.a];
    if (tick % 2 == 0) world.Barrier();
  }
  const int last = static_cast<int>(world.Read(0).position.x() + 20.5f);
  EXPECT_GT(last, 16);
  EXPECT_GE(static_cast<int>(told.size()), last - 10);
  for (const auto& [tile, times] : told) EXPECT_EQ(times, 1) << tile;
}

}  // namespace touch_log_test
}  // namespace seam
