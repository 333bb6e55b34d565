/// Featherweight bricks in a world: bodies that move on them and against them, beside ordinary
/// ground.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "common/topology/feather_blast.h"
#include "common/topology/feather_store.h"
#include "tests/support/scripted_world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace feather_world_test {

/// 500 m of pavement, 1000 bricks of 0.5 m wide in 63 cells, whose surface is y = 0; or one box.
std::string Pavement(bool bricks, const std::string& friction) {
  return bricks ? "[[bricks]]\nname = \"street\"\nbrick = [0.5, 0.25]\nposition = [-10, -0.5]\n"
                  "count = [1000, 2]\nfriction = " +
                      friction + "\n"
                : "[[part]]\nname = \"street\"\nbox = [500, 0.5]\nposition = [240, -0.25]\n"
                  "anchored = true\nfriction = " +
                      friction + "\n";
}

const std::string kSolvers[] = {"", "skin = 0.0025\n", "skin = 0.005\nsubsteps = 2\n"};

struct Ride {
  float x = 0, speed = 0, spin = 0, lowest = 1e9f, highest = -1e9f, turned = 0;
};

Ride RideOn(bool bricks, const std::string& mover, const std::string& friction,
            const std::string& solver, int ticks) {
  const auto world = SmallWorld(Pavement(bricks, friction) + mover, solver, "duration = 5");
  Ride ride;
  for (int i = 0; i < ticks; ++i) {
    world->Step();
    const BodyState s = world->Read(0);
    if (i < 60) continue;  // comes to lie first
    ride.lowest = std::min(ride.lowest, s.position.y());
    ride.highest = std::max(ride.highest, s.position.y());
    ride.turned = std::max(ride.turned, std::fabs(s.angle));
  }
  const BodyState s = world->Read(0);
  ride.x = s.position.x();
  ride.speed = s.velocity.x();
  ride.spin = s.spin;
  return ride;
}

TEST(Feather, ABoxSlidesOverAThousandBricksAsOverOnePlane) {
  for (const std::string& solver : kSolvers) {
    for (const char* bullet : {"false", "true"}) {
      const std::string box = std::string(
                                  "[[part]]\nname = \"box\"\nbox = [1, 1]\n"
                                  "position = [0, 0.5]\nfriction = 0\n"
                                  "velocity = [60, 0]\nbullet = ") +
                              bullet + "\n";
      const Ride on = RideOn(true, box, "0", solver, 450);
      const Ride plane = RideOn(false, box, "0", solver, 450);
      EXPECT_GT(on.x, 440) << "it has crossed " << 440 / 8 << " cells";
      EXPECT_NEAR(on.speed, plane.speed, 1e-4) << solver << bullet;
      EXPECT_NEAR(on.speed, 60, 1e-3) << solver << bullet;
      EXPECT_LT(on.highest - on.lowest, 1e-3) << solver << bullet;
      EXPECT_LT(on.turned, 1e-3) << solver << bullet;
    }
  }
}

TEST(Feather, ABoxBrakedByFrictionStopsAsOnOnePlane) {
  // v0^2 / (2 mu g), mu the root of 0.5 * 0.5: 90 m.
  const std::string box =
      "[[part]]\nname = \"box\"\nbox = [1, 0.4]\nposition = [0, 0.21]\n"
      "friction = 0.5\nvelocity = [30, 0]\n";
  for (const std::string& solver : kSolvers) {
    const Ride on = RideOn(true, box, "0.5", solver, 500);
    const Ride plane = RideOn(false, box, "0.5", solver, 500);
    EXPECT_NEAR(on.x, plane.x, 0.05) << solver;
    EXPECT_NEAR(on.x, 90, 1) << solver;
    EXPECT_NEAR(on.speed, 0, 1e-3) << solver;
  }
}

TEST(Feather, ADiscRollsOverAThousandBricksAsOverOnePlane) {
  for (const std::string& solver : kSolvers) {
    for (const char* bullet : {"false", "true"}) {
      const std::string disc = std::string(
                                   "[[part]]\nname = \"disc\"\ncircle = 0.5\n"
                                   "position = [0, 0.5]\nvelocity = [40, 0]\nspin = -80\n"
                                   "bullet = ") +
                               bullet + "\n";
      const Ride on = RideOn(true, disc, "0.5", solver, 600);
      const Ride plane = RideOn(false, disc, "0.5", solver, 600);
      EXPECT_GT(on.x, 390) << solver;
      EXPECT_NEAR(on.x, plane.x, 0.01) << solver << bullet;
      EXPECT_NEAR(on.speed, plane.speed, 1e-3) << solver << bullet;
      EXPECT_NEAR(on.spin, plane.spin, 2e-3) << solver << bullet;
      EXPECT_LT(on.highest - on.lowest, 1e-3) << solver << bullet;
    }
  }
}

TEST(Feather, ABoxSlidingDownAWallDoesNotCatchAtItsSeams) {
  // A wall of 100 m whose left side is x = 0; the box is pushed against it and falls 80 m.
  const std::string wall =
      "[[bricks]]\nname = \"wall\"\nbrick = [0.5, 0.25]\nposition = [0, 0]\n"
      "count = [4, 400]\nfriction = 0\n";
  const std::string box =
      "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [-0.51, 95]\n"
      "friction = 0\n";
  for (const std::string& solver : kSolvers) {
    const auto world = SmallWorld(wall + box, solver, "gravity = [5, -10]");
    Steps(world.get(), 240);
    const BodyState s = world->Read(0);
    EXPECT_NEAR(s.velocity.y(), -40, 1e-3) << solver << "free fall along it";
    EXPECT_NEAR(s.position.x(), -0.5, 0.03) << solver;
    EXPECT_NEAR(s.angle, 0, 2e-3) << solver;
  }
}

TEST(Feather, NothingFallsThroughAtTheHighestSpeed) {
  // Balls at 120 m/s from all sides at a block of 4 m that no cell's border divides evenly.
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 48;
    const double c = std::cos(angle), s = std::sin(angle);
    const std::string ball = "[[part]]\nname = \"ball\"\ncircle = 0.2\nposition = [" +
                             FloatDigits(61 + 70 * c) + ", " + FloatDigits(9 + 70 * s) +
                             "]\nvelocity = [" + FloatDigits(-119.9 * c) + ", " +
                             FloatDigits(-119.9 * s) + "]\nrestitution = 0.5\n";
    const auto world = SmallWorld(
        "[[bricks]]\nname = \"block\"\nbrick = [0.5, 0.25]\n"
        "position = [59, 7]\ncount = [8, 16]\n" +
            ball,
        "", "gravity = [0, 0]");
    float nearest = 100;
    for (int t = 0; t < 90; ++t) {
      world->Step();
      const Vec2 d = (world->Read(0).position - Vec2(61, 9)).cwiseAbs();
      nearest = std::min(nearest, d.maxCoeff());
    }
    EXPECT_GT(nearest, 2.15f) << i << ": it was inside";
    const Vec2 way(static_cast<float>(-c), static_cast<float>(-s));
    EXPECT_LT(world->Read(0).velocity.dot(way), 110) << i << ": it never touched";
  }
}

TEST(Feather, AMovedBodyFindsItsGround) {
  const auto world = SmallWorld(Pavement(true, "0.5") +
                                "[[part]]\nname = \"box\"\nbox = [1, 1]\n"
                                "position = [0, 0.5]\n");
  Steps(world.get(), 30);
  for (const float x : {400.0f, 3.0f, 250.5f}) {
    BodyState s = world->Read(0);
    s.position = Vec2(x, 0.51f);
    s.velocity = Vec2(0, -100);
    world->Write(0, s);
    Steps(world.get(), 30);
    EXPECT_NEAR(world->Read(0).position.y(), 0.5, 0.03) << x;
    EXPECT_NEAR(world->Read(0).position.x(), x, 1) << x;
  }
}

/// Sixty movers over towers and streets, as they fall, roll, settle and sleep.
Scene City(int movers) {
  std::string text =
      "bounds = [[-500, -50], [500, 200]]\n"
      "[[bricks]]\nname = \"street\"\nbrick = [1, 0.5]\nposition = [-300, -1]\n"
      "count = [600, 2]\n"
      "[[bricks]]\nname = \"towers\"\nbrick = [0.5, 0.25]\nposition = [-300, 0]\n"
      "friction = 0.7\n"
      "towers = {count = 30, pitch = 20, width = [8, 14], height = [6, 24], "
      "windows = true, seed = 3}\n";
  for (int i = 0; i < movers; ++i) {
    text += "[[part]]\nname = \"m" + std::to_string(i) + "\"\n" +
            (i % 2 == 0 ? "box = [0.8, 0.6]\n" : "circle = 0.4\nrestitution = 0.4\n") +
            "position = [" + FloatDigits(-290 + 580.0 * i / movers) + ", " +
            FloatDigits(26 + i % 7) + "]\nvelocity = [" + FloatDigits((i * 37) % 41 - 20) +
            ", 0]\n";
  }
  return ParseScene(text, "city.toml");
}

TEST(Feather, NothingIsLostInACity) {
  World world(City(60));
  for (int t = 0; t < 900; ++t) {
    world.Step();
    for (int body = 0; body < 60; ++body) {
      const BodyState s = world.Read(body);
      if (std::fabs(s.position.x()) < 299) {
        ASSERT_GT(s.position.y(), 0.25) << "body " << body << " at tick " << t;
      }
    }
  }
  int asleep = 0;
  for (int body = 0; body < 60; ++body) asleep += !world.awake(body);
  EXPECT_GT(asleep, 30);
}

TEST(Feather, ReplayFromABarrierIsBitExact) {
  World world(City(40));
  std::vector<std::uint64_t> hashes;
  std::vector<WorldSnapshot> barriers;
  for (int t = 1; t <= 300; ++t) {
    world.Step();
    if (t % 20 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  for (const WorldSnapshot& barrier : barriers) {
    EXPECT_TRUE(world.Restore(barrier).ok());
    ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(barrier.tick - 1)]);
    for (int i = 0; i < 45 && world.tick() < 300; ++i) {
      world.Step();
      if (world.tick() % 20 == 0) world.Barrier();
      ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick() - 1)])
          << "from " << barrier.tick << " at " << world.tick();
    }
  }
}

TEST(Feather, ASleeperKeepsItsGroundUnderAFarTraveller) {
  const auto text = Pavement(true, "0.5") +
                    "[[part]]\nname = \"sleeper\"\nbox = [1, 1]\nposition = [7.6, 0.5]\n"
                    "[[part]]\nname = \"traveller\"\nbox = [1, 1]\nposition = [12, 0.5]\n"
                    "velocity = [50, 0]\nfriction = 0\n";
  World world(ParseScene(text, "s.toml"));
  for (int t = 0; t < 400; ++t) world.Step();
  ASSERT_FALSE(world.awake(0));
  const BodyState before = world.Read(0);
  world.SetAwake(0, true);
  for (int t = 0; t < 60; ++t) world.Step();
  EXPECT_NEAR(world.Read(0).position.y(), before.position.y(), 1e-3);
  EXPECT_GT(world.Read(1).position.x(), 300);
}

TEST(Feather, ABlastInTwoWorldsIsTheSameBitForBit) {
  World one(City(30)), two(City(30));
  BlastEdit blast{{-296, 3}, 2.5f, 25};
  for (int t = 0; t < 300; ++t) {
    if (t == 60 || t == 150) {
      for (World* world : {&one, &two}) {
        const int before = world->body_count();
        ASSERT_TRUE(world->Apply({Edit(blast)}).has_value());
        EXPECT_GT(world->body_count(), before + 5);
        EXPECT_LE(world->body_count(), before + kBlastPiecesMax);
      }
      blast.centre.y() += 2;
    }
    one.Step();
    two.Step();
    if (t % 30 == 7) {
      EXPECT_TRUE(two.Restore(two.Barrier()).ok());
    }
    if (t % 30 == 7) one.Barrier();
    ASSERT_EQ(one.Hash(), two.Hash()) << t;
  }
  for (int body = 0; body < one.body_count(); ++body) {
    if (std::fabs(one.Read(body).position.x()) > 299) continue;
    EXPECT_GT(one.Read(body).position.y(), -0.1) << one.id(body) << " is on the street or above";
  }
}

TEST(Feather, ABlastCostsNoMoreInAGreatCityThanInASmallOne) {
  // Median CPU time of blasts that free bricks, of five after the first.
  const auto cost_ms = [](int towers, std::size_t least) {
    World world(
        ParseScene("[[charges]]\nname = \"c\"\nposition = [0, 0]\nradius = 1\n"
                   "impulse = 1\nat = 9\n[[part]]\nname = \"box\"\nbox = [1, 1]\n"
                   "position = [-9, 9]\n[[bricks]]\nname = \"city\"\n"
                   "brick = [0.5, 0.25]\nposition = [0, 0]\ntowers = {count = " +
                       std::to_string(towers) +
                       ", pitch = 20, width = [8, 14], height = [20, 48], seed = 1}\n",
                   "city.toml"));
    EXPECT_GT(world.topology().BricksLeft().size(), least);
    std::vector<double> ms;
    for (int i = 0; i < 6; ++i) {
      const int before = world.body_count();
      const std::clock_t from = std::clock();
      world.Apply({Edit(BlastEdit{{4 + 20.0f * static_cast<float>(i), 20}, 1, 10, 5})});
      if (i > 0) ms.push_back(1e3 * static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC);
      EXPECT_GT(world.body_count(), before);
    }
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  };
  const double small = cost_ms(8, 10'000), great = cost_ms(500, 1'000'000);
  std::printf("[          ] a blast in a city of 8 towers %.2f ms, of 500 %.2f ms\n", small, great);
  EXPECT_LT(great, 4 * small + 1);
}

TEST(Feather, BricksAsPartsAreTheSameBricks) {
  const std::string wall =
      "[[bricks]]\nname = \"wall\"\nbrick = [0.5, 0.25]\nposition = [-4, 0]\n"
      "towers = {count = 3, pitch = 12, width = [3, 6], height = [3, 9], "
      "windows = true, seed = 2}\nfeatherweight = ";
  const std::string ball =
      "\n[[part]]\nname = \"ball\"\ncircle = 0.5\nposition = [1, 12]\n"
      "restitution = 0.3\n";
  World feather(ParseScene(wall + "true" + ball, "s.toml"));
  World parts(ParseScene(wall + "false" + ball, "s.toml"));
  EXPECT_EQ(feather.scene().parts.size(), 1u);
  EXPECT_GT(parts.scene().parts.size(), 300u);
  for (int t = 0; t < 60; ++t) {
    feather.Step();
    parts.Step();
  }
  // Straight down onto a roof: the engine's rim of boxes makes the difference.
  EXPECT_NEAR(feather.Read(0).position.y(), parts.Read(0).position.y(), 0.1);
}

}  // namespace feather_world_test
}  // namespace seam
