/// Explosions push visible bodies by silhouette and distance, and cover counts.

#include "common/physics/blast_push.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "common/base/geometry.h"
#include "common/physics/faces.h"
#include "common/physics/part_places.h"
#include "common/physics/world.h"
#include "common/scene/scene.h"

namespace seam {
namespace blast_push_test {

const std::string kWeightless = "gravity = [0, 0]\n";

std::string Crate(const std::string& name, float x, float y, const std::string& more = "") {
  return "[[part]]\nname = \"" + name + "\"\nbox = [1, 1]\nposition = [" + std::to_string(x) +
         ", " + std::to_string(y) + "]\n" + more;
}

/// A room in which a blast at [0, 0] of 6 m and 40 N s/m has just gone off.
class Blasted {
 public:
  explicit Blasted(const std::string& text, BlastEdit blast = {{0, 0}, 6, 0, 40})
      : world(ParseScene(kWeightless + text, "blast.toml")) {
    world.Apply({Edit(blast)});
  }
  Vec2 Momentum(const std::string& name) const {
    const BodyState state = Of(name);
    return state.velocity * world.mass(BodyNamed(name));
  }
  BodyState Of(const std::string& name) const { return world.Read(BodyNamed(name)); }
  int BodyNamed(const std::string& name) const {
    for (const Part& part : world.scene().parts) {
      if (part.name == name) return world.BodyOfId(part.id);
    }
    return -1;
  }
  World world;
};

/// Impulse along x on a face at x = `face` from y = -half to half: by the angle, in small steps.
double OnFace(double face, double half, double radius, double impulse) {
  double sum = 0;
  const int steps = 10000;
  for (int i = 0; i < steps; ++i) {
    const double y = half * (2 * (i + 0.5) / steps - 1), r = std::hypot(face, y);
    if (r > radius) continue;
    // A metre of silhouette is r dtheta = cos dy; of the push along the ray cos goes along x.
    sum += impulse * (1 - r / radius) * (face / r) * (face / r) * (2 * half / steps);
  }
  return sum;
}

TEST(BlastPush, IsTheIntegralOverTheSilhouette) {
  for (const float x : {1.5f, 2.5f, 4.0f, 5.0f}) {
    const Blasted b(Crate("crate", x, 0));
    const double whole = OnFace(static_cast<double>(x) - 0.5, 0.5, 6, 40);
    EXPECT_NEAR(b.Momentum("crate").x(), whole, 0.03 * whole + 0.05) << x;
    EXPECT_NEAR(b.Momentum("crate").y(), 0, 0.02 * whole + 0.05) << x;
  }
  EXPECT_EQ(Blasted(Crate("crate", 6.6f, 0)).Momentum("crate"), Vec2(0, 0));
}

TEST(BlastPush, ACrateAtTwoMetresFliesAndBehindAWallTakesLessThanATwentieth) {
  const float open = Blasted(Crate("crate", 2, 0)).Momentum("crate").norm();
  EXPECT_GT(open, 15);
  const std::string wall =
      "[[part]]\nname = \"wall\"\nbox = [0.2, 3]\nposition = [1, 0]\nanchored = true\n";
  const std::string chain = "[[part]]\nname = \"wall\"\nchain = [[1, -2], [1, 2]]\n";
  const std::string bricks =
      "[[bricks]]\nname = \"wall\"\nbrick = [0.2, 0.5]\nposition = [0.9, -1.5]\ncount = [1, 6]\n";
  for (const std::string& cover : {wall, chain, bricks}) {
    EXPECT_LT(Blasted(Crate("crate", 2, 0) + cover).Momentum("crate").norm(), open / 20) << cover;
  }
  const Blasted row(Crate("first", 2, 0) + Crate("second", 3.2f, 0));
  EXPECT_NEAR(row.Momentum("first").norm(), open, 0.01 * open) << "the first takes it";
  EXPECT_LT(row.Momentum("second").norm(), open / 20);
}

TEST(BlastPush, AWallThatTheSameBlastBreaksCoversLikeOneThatStands) {
  const std::string crate = Crate("crate", 3.5f, 0);
  const float open = Blasted(crate).Momentum("crate").norm();
  for (const float brick : {0.1f, 0.2f, 0.5f}) {
    const int columns = static_cast<int>(std::lround(0.5f / brick));
    const int rows = static_cast<int>(std::lround(4 / brick));
    const std::string wall = "[[bricks]]\nname = \"wall\"\nbrick = [" + std::to_string(brick) +
                             ", " + std::to_string(brick) + "]\nposition = [1.5, -2]\ncount = [" +
                             std::to_string(columns) + ", " + std::to_string(rows) + "]\n";
    const Blasted behind(wall + crate, {{0, 0}, 6, 20, 40});
    EXPECT_GT(behind.world.body_count(), 4) << "it breaks";
    std::printf("[          ] through a wall that breaks into bricks of %g m: %.1f %%\n",
                static_cast<double>(brick),
                static_cast<double>(100 * behind.Momentum("crate").norm() / open));
    EXPECT_LT(behind.Momentum("crate").norm(), 0.01f * open) << brick;
  }
}

TEST(BlastPush, AWallOfGluedBoxesThatItBreaksCovers) {
  const std::string crate = Crate("crate", 3.5f, 0);
  const float open = Blasted(crate).Momentum("crate").norm();
  for (const float size : {0.1f, 0.25f, 0.5f}) {
    const int rows = static_cast<int>(std::lround(4 / size));
    const std::string box = std::to_string(size);
    const std::string wall = "[[part]]\nname = \"wall\"\nbox = [" + box + ", " + box +
                             "]\nposition = [1.5, " + std::to_string(size / 2 - 2) +
                             "]\nrepeat = {count = " + std::to_string(rows) + ", step = [0, " +
                             box + "], glue = 5}\n";
    Blasted behind(wall + crate, {{0, 0}, 6, 20, 40});
    const float through = behind.Momentum("crate").norm();
    behind.world.Step();
    EXPECT_FALSE(behind.world.ProposeEdits().empty()) << "it breaks";
    std::printf("[          ] through a wall of glued boxes of %g m: %.1f %%\n",
                static_cast<double>(size), static_cast<double>(100 * through / open));
    EXPECT_LT(through, 0.01f * open) << size;
  }
}

TEST(BlastPush, ABodyAroundTheCentreNeitherCoversNorIsPushed) {
  const float open = Blasted(Crate("crate", 2, 0)).Momentum("crate").norm();
  const Blasted b(Crate("crate", 2, 0) + Crate("bomb", 0.1f, 0.1f));
  EXPECT_NEAR(b.Momentum("crate").norm(), open, 1e-3f * open);
  EXPECT_EQ(b.Momentum("bomb"), Vec2(0, 0));
}

TEST(BlastPush, HalfACoverLeavesHalfThePushAndTurnsTheCrate) {
  const float open = Blasted(Crate("crate", 2, 0)).Momentum("crate").x();
  const Blasted b(
      Crate("crate", 2, 0) +
      "[[part]]\nname = \"wall\"\nbox = [0.2, 2]\nposition = [1, -1]\nanchored = true\n");
  EXPECT_NEAR(b.Momentum("crate").x(), open / 2, 0.05f * open);
  EXPECT_LT(b.Of("crate").spin, -1) << "pushed to the right above its middle: clockwise";
}

TEST(BlastPush, ThrowsARingOfDiscsOutwardsEqually) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.3 + i * 3.14159265 / 4;
    text += "[[part]]\nname = \"d" + std::to_string(i) + "\"\ncircle = 0.4\nposition = [" +
            std::to_string(3 * std::cos(angle)) + ", " + std::to_string(3 * std::sin(angle)) +
            "]\n";
  }
  const Blasted b(text);
  Vec2 sum(0, 0);
  for (int i = 0; i < 8; ++i) {
    const Vec2 p = b.Momentum("d" + std::to_string(i)),
               out = b.Of("d" + std::to_string(i)).position;
    EXPECT_GT(p.dot(out), 0.999f * p.norm() * out.norm()) << i;
    EXPECT_NEAR(p.norm(), b.Momentum("d0").norm(), 0.05f * p.norm());
    sum += p;
  }
  EXPECT_LT(sum.norm(), 0.05f * b.Momentum("d0").norm());
}

TEST(BlastPush, WakesSleepersKeepsTheSpeedLimitAndSparesAnchoredBodies) {
  Blasted b("speed_limit = 20\n" + Crate("light", 2, 0, "density = 0.01\n") +
            Crate("post", -2, 0, "anchored = true\n"));
  EXPECT_NEAR(b.Of("light").velocity.norm(), 20, 1e-3);
  World world(ParseScene(kWeightless + Crate("crate", 2, 0), "sleep.toml"));
  for (int t = 0; t < 60; ++t) world.Step();
  ASSERT_FALSE(world.awake(0));
  EXPECT_FALSE(world.Apply({Edit(BlastEdit{{0, 0}, 6, 0, 40})}).has_value());
  EXPECT_TRUE(world.awake(0));
}

TEST(BlastPush, RepeatsBitForBitAfterGoingBack) {
  World world(ParseScene("[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n" +
                             Crate("a", 2, 0.5f) + Crate("b", -2, 0.5f) + Crate("c", -2, 1.6f),
                         "again.toml"));
  for (int t = 0; t < 10; ++t) world.Step();
  const WorldSnapshot before = world.Barrier();
  const Edit blast(BlastEdit{{0, 0.3f}, 6, 0, 10});
  EXPECT_FALSE(world.Apply({blast}).has_value());
  for (int t = 0; t < 30; ++t) world.Step();
  const std::uint64_t hash = world.Hash();
  ASSERT_TRUE(world.Restore(before).ok());
  world.Repeat(blast);
  for (int t = 0; t < 30; ++t) world.Step();
  EXPECT_EQ(world.Hash(), hash);
  EXPECT_GT(world.Read(0).position.x(), 2.3f) << "it did something";
}

TEST(BlastPush, AnInvalidBlastIsRefusedAndPushesNothing) {
  const float nan = std::nanf("");
  const BlastEdit wrong[] = {{{nan, 0}, 6, 0, 40}, {{0, 0}, nan, 0, 40},  {{0, 0}, 6, nan, 40},
                             {{0, 0}, 6, 0, nan},  {{0, 0}, 6, 0, -1},    {{0, 0}, -6, 0, 40},
                             {{0, 0}, 11, 0, 40},  {{0, 0}, 6, 0, 1e30f}, {{0, 0}, 6, 0, 0}};
  for (const BlastEdit& blast : wrong) {
    Blasted b(Crate("crate", 2, 0), blast);
    EXPECT_EQ(b.Momentum("crate"), Vec2(0, 0));
    EXPECT_FALSE(b.world.topology().Validate(Edit(blast)).ok());
    b.world.Repeat(Edit(blast));
    EXPECT_EQ(b.Momentum("crate"), Vec2(0, 0));
  }
}

TEST(BlastPush, BreaksGlueThatBearsLessAndLeavesStrongerGlue) {
  for (const auto& [strength, breaks] : {std::pair{200.0f, true}, std::pair{20000.0f, false}}) {
    Blasted b(Crate("a", 2, 0) + Crate("b", 2, 1) +
              "[[joint]]\nname = \"g\"\nkind = \"glue\"\na = \"a\"\nb = \"b\"\nstrength = " +
              std::to_string(strength) + "\n");
    const WorldSnapshot barrier = b.world.Barrier();
    for (int again = 0; again < 2; ++again) {
      b.world.Step();
      EXPECT_EQ(b.world.ProposeEdits().size(), breaks ? 1u : 0u) << strength << " " << again;
      ASSERT_TRUE(b.world.Restore(barrier).ok()) << "the strain is part of the snapshot";
    }
  }
}

TEST(BlastPush, EachOfManyBlastsOfOneTickLoadsTheGlue) {
  std::string pairs;
  constexpr int kPairs = 12;
  for (int i = 0; i < kPairs; ++i) {
    const std::string n = std::to_string(i);
    const auto x = static_cast<float>(20 * i + 2);
    pairs += Crate("a" + n, x, 0) + Crate("b" + n, x, 1);
  }
  for (int i = 0; i < kPairs; ++i) {
    const std::string n = std::to_string(i);
    pairs += "[[joint]]\nname = \"g" + n + "\"\nkind = \"glue\"\na = \"a" + n + "\"\nb = \"b" + n +
             "\"\nstrength = 200\n";
  }
  Blasted b(pairs);
  for (int i = 1; i < kPairs; ++i) {
    b.world.Apply({Edit(BlastEdit{{static_cast<float>(20 * i), 0}, 6, 0, 40})});
  }
  const WorldSnapshot barrier = b.world.Barrier();
  for (int again = 0; again < 2; ++again) {
    b.world.Step();
    EXPECT_EQ(b.world.ProposeEdits().size(), static_cast<std::size_t>(kPairs)) << again;
    ASSERT_TRUE(b.world.Restore(barrier).ok());
  }
}

TEST(BlastPush, PrintsTheCostOfABlastAmongAThousandBodies) {
  World world(
      ParseScene("[[part]]\nname = \"ground\"\nchain = [[-40, 0], [40, 0]]\n"
                 "[[part]]\nname = \"box\"\nbox = [0.4, 0.4]\nposition = [-10, 0.25]\n"
                 "repeat = {count = [50, 20], step = [0.42, 0.415]}\n",
                 "many.toml"));
  const auto ms = [](std::clock_t from, std::clock_t to) {
    return 1e3 * static_cast<double>(to - from) / CLOCKS_PER_SEC;
  };
  for (int t = 0; t < 5; ++t) world.Step();
  const std::clock_t begin = std::clock();
  for (int t = 0; t < 20; ++t) world.Step();
  const std::clock_t middle = std::clock();
  for (int i = 0; i < 20; ++i) world.Repeat(Edit(BlastEdit{{0.21f, 8.5f}, 10, 0, 0.01f}));
  const std::clock_t end = std::clock();
  std::printf("[          ] 1000 boxes: a blast %.2f ms of CPU time, %.2f of a step's\n",
              ms(middle, end) / 20, ms(middle, end) / ms(begin, middle));
  EXPECT_GT(world.Read(0).position.y(), 0);
}

/// Which of all parts is nearest to a point, by looking at each of them, turned.
PartId NearestOfAll(const Scene& scene, const std::vector<PartId>& parts,
                    const Eigen::Vector2d& point) {
  PartId nearest = -1;
  double least = 1e30;
  for (const PartId id : parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const Eigen::Vector2d local =
        Turned(point - part.position.cast<double>(), -static_cast<double>(part.angle));
    const Eigen::Vector2d half = part.size.cast<double>() / 2;
    const double out = (local.cwiseAbs() - half).cwiseMax(0.0).norm();
    if (out < least) nearest = id;
    least = std::min(least, out);
  }
  return nearest;
}

TEST(BlastPush, TheTickAfterItCostsLittleBesideAThousandGluedBoxes) {
  World world(
      ParseScene("[[part]]\nname = \"ground\"\nchain = [[-40, 0], [40, 0]]\n"
                 "[[part]]\nname = \"box\"\nbox = [0.5, 0.5]\nposition = [-12.5, 0.26]\n"
                 "repeat = {count = [50, 20], step = [0.5, 0.5], glue = 3000}\n",
                 "glued.toml"));
  for (int t = 0; t < 60; ++t) world.Step();
  const std::vector<PartId>& boxes = world.composition().assemblies.back().parts;
  ASSERT_EQ(boxes.size(), 1000u);
  const WorldSnapshot barrier = world.Barrier();
  std::clock_t step = std::numeric_limits<std::clock_t>::max(), look = step;
  for (int i = 0; i < 9; ++i) {
    ASSERT_TRUE(world.Restore(barrier).ok());
    world.Repeat(Edit(BlastEdit{{-14, 3}, 8, 0, 30}));
    const std::clock_t begin = std::clock();
    world.Step();
    const std::clock_t middle = std::clock();
    for (int j = 0; j < 20; ++j) {
      const Eigen::Vector2d point(j, 5);
      EXPECT_EQ(NearestOfAll(world.scene(), boxes, point),
                NearestPart(world.scene(), boxes, point));
    }
    step = std::min(step, middle - begin);
    look = std::min(look, std::clock() - middle);
  }
  const double looks = 20 * static_cast<double>(step) / static_cast<double>(look);
  std::printf("[          ] %.2f ms, as much as %.0f looks at all boxes\n",
              1e3 * static_cast<double>(step) / CLOCKS_PER_SEC, looks);
  EXPECT_LT(looks, 100) << "170 where each push looks at all boxes";
}

}  // namespace blast_push_test
}  // namespace seam
