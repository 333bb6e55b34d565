/// Mechanisms that `auto` leaves to the engine from the beginning: they are the engine's, bit for
/// bit, alone and beside others that are solved exactly.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace {

/// Discs at distances of 1 m, each joined to its neighbours, that come down at 50 m/s.
std::string FallingGrid() {
  constexpr int kSide = 14;
  const std::string count = std::to_string(kSide), less = std::to_string(kSide - 1);
  return PartText("ground", "box = [60, 1]\nposition = [6, -0.5]\nanchored = true") +
         PartText("disc",
                  "circle = 0.4\nposition = [0, 1.3]\nvelocity = [0, -50]\ngroup = -1\n"
                  "repeat = {count = [" +
                      count + ", " + count + "], step = [1, 1]}") +
         HingeText("up", "disc.0.0", "disc.0.1", 0, 1.8,
                   "repeat = {count = [" + count + ", " + less + "], step = [1, 1]}") +
         HingeText("across", "disc.0.0", "disc.1.0", 0.5, 1.3,
                   "repeat = {count = [" + less + ", " + count + "], step = [1, 1]}");
}

std::string FarPendulum() {
  return PostText(40, 5) + PartText("bob", "box = [2, 0.1]\nposition = [41, 5]") +
         HingeText("pivot", "post", "bob", 40, 5);
}

/// What both worlds have of the first `bodies`, and what hits them, in half a second.
void ExpectTheSame(World* ours, World* engines, int bodies) {
  std::size_t heard = 0;
  for (int tick = 0; tick < 30; ++tick) {
    ours->Step();
    engines->Step();
    for (int body = 0; body < bodies; ++body) {
      ASSERT_EQ(ours->Read(body).position, engines->Read(body).position) << tick << " " << body;
    }
    ASSERT_EQ(ours->impacts().size(), engines->impacts().size()) << tick;
    for (std::size_t i = 0; i < ours->impacts().size(); ++i) {
      EXPECT_EQ(ours->impacts()[i].dv, engines->impacts()[i].dv) << tick;
    }
    heard += ours->impacts().size();
  }
  EXPECT_GT(heard, 10u) << "it hits the ground";
}

TEST(ExactLeft, AGridIsTheEngines) {
  const auto ours = SmallWorld(FallingGrid());
  const auto engines = SmallWorld(FallingGrid(), "joints = \"iterative\"\n");
  ExpectTheSame(ours.get(), engines.get(), 196);
  EXPECT_EQ(ours->Hash(), engines->Hash());
}

TEST(ExactLeft, BesideAnExactPendulumItIsAsWellAndItsBlowsAreHeard) {
  const auto ours = SmallWorld(FallingGrid() + FarPendulum());
  const auto engines = SmallWorld(FallingGrid() + FarPendulum(), "joints = \"iterative\"\n");
  ExpectTheSame(ours.get(), engines.get(), 196);
  EXPECT_NE(ours->Hash(), engines->Hash()) << "the pendulum is solved exactly";
}

}  // namespace
}  // namespace seam
