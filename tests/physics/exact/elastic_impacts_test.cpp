/// Perfectly elastic impacts between bodies without joints: energy, order and reports.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace elastic_impacts_test {

constexpr const char* kWeightless = "gravity = [0, 0]\n";

std::string Elastic(const std::string& name, const std::string& rest, double friction = 0) {
  return PartText(name, rest + "\nrestitution = 1\nfriction = " + FloatDigits(friction));
}

/// A closed box of 12 m by 12 m.
std::string Walls() {
  std::string text;
  int side = 0;
  for (const char* place :
       {"box = [14, 1]\nposition = [0, -6.5]", "box = [14, 1]\nposition = [0, 6.5]",
        "box = [1, 14]\nposition = [-6.5, 0]", "box = [1, 14]\nposition = [6.5, 0]"}) {
    text += Elastic("wall" + std::to_string(side++), std::string(place) + "\nanchored = true");
  }
  return text;
}

/// Twenty-five discs or squares that fly about; a quarter of the box is theirs.
std::string Gas(const std::string& shape, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> speed(-8, 8);
  std::string text = Walls();
  for (int i = 0; i < 25; ++i) {
    const double x = i % 5 * 2.2 - 4.4, y = i / 5 * 2.2 - 4.4;
    const double vx = speed(random), vy = speed(random);
    text += Elastic("disc" + std::to_string(i), shape + "\nposition = [" + FloatDigits(x) + ", " +
                                                    FloatDigits(y) + "]\nvelocity = [" +
                                                    FloatDigits(vx) + ", " + FloatDigits(vy) + "]");
  }
  return text;
}

/// The greatest change of the energy in 20 s, as a share of it.
double EnergyChange(const std::string& parts, const std::string& solver) {
  const auto world = SmallWorld(parts, solver, kWeightless);
  const double begin = world->Energy();
  double most = 0;
  for (int tick = 0; tick < 1200; ++tick) {
    world->Step();
    most = std::max(most, std::fabs(world->Energy() / begin - 1));
  }
  return most;
}

TEST(ElasticImpacts, DiscsInAClosedBoxKeepTheirEnergyAtAnySubsteps) {
  for (const int substeps : {1, 2, 3, 8}) {
    for (const unsigned seed : {11u, 12u}) {
      const std::string solver = "substeps = " + std::to_string(substeps) + "\n";
      EXPECT_LT(EnergyChange(Gas("circle = 0.6", seed), solver), 1e-4) << substeps << " " << seed;
    }
  }
}

TEST(ElasticImpacts, TheEngineAloneLosesTheEnergy) {
  EXPECT_GT(EnergyChange(Gas("circle = 0.6", 11), "joints = \"iterative\"\n"), 2e-3);
}

TEST(ElasticImpacts, TumblingSquaresKeepTheirEnergy) {
  EXPECT_LT(EnergyChange(Gas("box = [1, 1]", 13), ""), 1e-3);
}

TEST(ElasticImpacts, ABallUnderGravityComesBackToItsHeight) {
  const auto highest = [](const std::string& solver) {
    const auto world =
        SmallWorld(Elastic("ground", "box = [20, 1]\nposition = [0, -0.5]\nanchored = true") +
                       Elastic("ball", "circle = 0.5\nposition = [0, 3]"),
                   solver);
    double height = 0;
    for (int tick = 0; tick < 1800; ++tick) {
      world->Step();
      if (tick > 1600) height = std::max(height, static_cast<double>(world->Read(0).position.y()));
    }
    return height;
  };
  EXPECT_NEAR(highest("continuous = false\n"), 3, 0.1);
  EXPECT_NEAR(highest("substeps = 4\n"), 3, 0.1);
  EXPECT_GT(highest("joints = \"iterative\"\n"), 4);  // the engine throws it higher and higher
}

/// Remaining share of the energy of thirty squares that fall into a pit, after 20 s.
double LeftInAPit(const std::string& solver) {
  std::string parts = Elastic("floor", "box = [9, 1]\nposition = [0, -0.5]\nanchored = true");
  for (const int side : {-1, 1}) {
    parts +=
        Elastic("side" + std::to_string(side + 1),
                "box = [1, 40]\nposition = [" + FloatDigits(4 * side) + ", 20]\nanchored = true");
  }
  for (int i = 0; i < 30; ++i) {
    const double x = i % 6 * 1.1 - 2.7 + 0.03 * (i / 6);
    parts +=
        Elastic("square" + std::to_string(i), "box = [0.7, 0.7]\nposition = [" + FloatDigits(x) +
                                                  ", " + FloatDigits(1 + i / 6 * 1.2) + "]");
  }
  const auto world = SmallWorld(parts, solver);
  const double begin = world->Energy();
  Steps(world.get(), 1200);
  return world->Energy() / begin;
}

TEST(ElasticImpacts, APileUnderGravityKeepsItsEnergy) {
  EXPECT_NEAR(LeftInAPit(""), 1, 0.03);
  EXPECT_NEAR(LeftInAPit("substeps = 4\n"), 1, 0.01);
  EXPECT_GT(LeftInAPit("joints = \"iterative\"\n"), 1.1);  // the engine heats it
}

TEST(ElasticImpacts, TheLastDiscOfARowFlies) {
  std::string parts;
  for (int i = 0; i < 5; ++i) {
    parts += Elastic("disc" + std::to_string(i),
                     "circle = 0.5\nposition = [" + FloatDigits(i * 0.999) + ", 0]");
  }
  parts += Elastic("one", "circle = 0.5\nposition = [-1.2, 0]\nvelocity = [4, 0]");
  const auto world = SmallWorld(parts, "", kWeightless);
  Steps(world.get(), 20);
  for (int body = 0; body < 6; ++body) {
    EXPECT_NEAR(world->Read(body).velocity.x(), body == 4 ? 4 : 0, 1e-5) << body;
  }
}

TEST(ElasticImpacts, SlowImpactsBounceWithoutGravity) {
  const auto world =
      SmallWorld(Walls() + Elastic("disc", "circle = 0.5\nposition = [5, 0]\nvelocity = [0.3, 0]"),
                 "", kWeightless);
  Steps(world.get(), 180);
  EXPECT_NEAR(world->Read(0).velocity.x(), -0.3, 1e-6);
}

TEST(ElasticImpacts, ABoxAtRestOnElasticGroundStaysAtRest) {
  const auto world =
      SmallWorld(Elastic("ground", "box = [20, 1]\nposition = [0, -0.5]\nanchored = true", 0.5) +
                 Elastic("box", "box = [1, 1]\nposition = [0, 0.505]", 0.5));
  Steps(world.get(), 300);
  EXPECT_NEAR(world->Read(0).position.y(), 0.5, 0.02);
  EXPECT_LT(world->Read(0).velocity.norm(), 0.01f);
}

TEST(ElasticImpacts, WithFrictionNoEnergyIsGained) {
  const auto world =
      SmallWorld(Elastic("ground", "box = [200, 1]\nposition = [0, -0.5]\nanchored = true", 0.6) +
                     Elastic("box", "box = [1, 0.7]\nposition = [0, 3]\nspin = 9", 0.6),
                 "continuous = false\n");
  const double begin = world->Energy();
  for (int tick = 0; tick < 600; ++tick) {
    world->Step();
    // The error of a step of 1/60 s under gravity: 8 m/s by 0.16 m/s.
    EXPECT_LT(world->Energy(), begin + 0.7 * 8 * 0.17) << tick;
  }
}

TEST(ElasticImpacts, RestitutionBelowOneIsLeftToTheEngine) {
  std::string parts = Gas("circle = 0.6", 14);
  for (std::size_t at = 0; (at = parts.find("restitution = 1\n", at)) != std::string::npos; ++at) {
    parts.replace(at, 15, "restitution = 0.9");
  }
  const auto ours = SmallWorld(parts, "", kWeightless);
  const auto engines = SmallWorld(parts, "joints = \"iterative\"\n", kWeightless);
  Steps(ours.get(), 200);
  Steps(engines.get(), 200);
  EXPECT_EQ(ours->Hash(), engines->Hash());
}

TEST(ElasticImpacts, AreReportedAsImpacts) {
  const auto world =
      SmallWorld(Elastic("left", "circle = 0.5\nposition = [-1, 0]\nvelocity = [3, 0]") +
                     Elastic("right", "circle = 0.5\nposition = [1, 0]\nvelocity = [-3, 0]"),
                 "", kWeightless);
  std::vector<Impact> heard;
  for (int tick = 0; tick < 60; ++tick) {
    world->Step();
    heard.insert(heard.end(), world->impacts().begin(), world->impacts().end());
  }
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_NEAR(heard[0].dv, 6, 1e-4);
}

TEST(ElasticImpacts, ReplayBitForBit) {
  const auto world = SmallWorld(Gas("circle = 0.6", 15), "substeps = 2\n", kWeightless);
  Steps(world.get(), 50);
  const WorldSnapshot barrier = world->Barrier();
  std::vector<std::uint64_t> hashes;
  for (int tick = 0; tick < 60; ++tick) {
    world->Step();
    hashes.push_back(world->Hash());
  }
  ASSERT_TRUE(world->Restore(barrier).ok());
  for (int tick = 0; tick < 60; ++tick) {
    world->Step();
    ASSERT_EQ(world->Hash(), hashes[static_cast<std::size_t>(tick)]) << tick;
  }
}

}  // namespace elastic_impacts_test
}  // namespace seam
