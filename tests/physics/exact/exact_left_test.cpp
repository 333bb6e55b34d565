/// `auto` leaves mechanisms to the engine: those too large from the start bit for bit, alone and
/// beside exactly solved ones; and expensive ones in a heap for a while.

#include <gtest/gtest.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace exact_left_test {

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

/// Expects both worlds to have the same first `bodies` and impacts on them for half a second.
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

TEST(ExactLeftToEngine, AGridIsLeftToTheEngine) {
  const auto ours = SmallWorld(FallingGrid());
  const auto engines = SmallWorld(FallingGrid(), "joints = \"iterative\"\n");
  ExpectTheSame(ours.get(), engines.get(), 196);
  EXPECT_EQ(ours->Hash(), engines->Hash());
}

TEST(ExactLeftToEngine, BesideAnExactPendulumAGridIsLeftTooWithItsImpacts) {
  const auto ours = SmallWorld(FallingGrid() + FarPendulum());
  const auto engines = SmallWorld(FallingGrid() + FarPendulum(), "joints = \"iterative\"\n");
  ExpectTheSame(ours.get(), engines.get(), 196);
  EXPECT_NE(ours->Hash(), engines->Hash()) << "the pendulum is solved exactly";
}

/// A blade on a rail that shoves four hundred boxes.
std::string ShovedHeap() {
  return PartText("ground", "box = [80, 1]\nposition = [0, -0.5]\nanchored = true") +
         PartText("box",
                  "box = [0.6, 0.6]\nposition = [0, 0.315]\n"
                  "repeat = {count = [40, 10], step = [0.62, 0.615]}") +
         PostText(-6, -3) +
         PartText("blade", "box = [0.5, 7]\nposition = [-0.7, 3.55]\ndensity = 3\ngroup = -1") +
         "[[joint]]\nname = \"rail\"\nkind = \"prismatic\"\na = \"post\"\nb = \"blade\"\n" +
         "axis = [1, 0]\nmotor = {speed = 1, force = 900}\n";
}

/// us of this thread's time for five ticks.
double CostOfTicks(World* world) {
  timespec begin{}, end{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  for (int tick = 0; tick < 5; ++tick) world->Step();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  return static_cast<double>(end.tv_sec - begin.tv_sec) * 1e6 +
         static_cast<double>(end.tv_nsec - begin.tv_nsec) * 1e-3;
}

TEST(ExactLeftToEngine, AHeapThatABladeShovesCostsLittleMoreThanTheEngines) {
  const auto ours = SmallWorld(ShovedHeap());
  const auto engines = SmallWorld(ShovedHeap(), "joints = \"iterative\"\n");
  for (World* world : {ours.get(), engines.get()}) {
    for (int tick = 0; tick < 60; ++tick) world->Step();
  }
  // The shortest of eight stretches of each, in turns: the machine's speed may change.
  double ours_us = 1e30, engines_us = 1e30;
  for (int stretch = 0; stretch < 8; ++stretch) {
    ours_us = std::min(ours_us, CostOfTicks(ours.get()));
    engines_us = std::min(engines_us, CostOfTicks(engines.get()));
  }
  std::printf("[          ] %.2f times the engine's\n", ours_us / engines_us);
  // To order and shape it in each tick before it is left would cost several times as much.
  EXPECT_LT(ours_us, 1.7 * engines_us);
}

/// A cart that drives into a heap of crates before a wall: the exact solver meets crates with more
/// contacts than degrees of freedom.
std::string CartIntoCrates(int columns) {
  const auto wheel = [](const std::string& name, const std::string& x) {
    return PartText(name, "circle = 0.4\nposition = [" + x + ", 0.4]\nfriction = 0.9") +
           "[[joint]]\nname = \"axle-" + name + "\"\nkind = \"wheel\"\na = \"cart\"\nb = \"" +
           name + "\"\nfrequency = 5\nmotor = {speed = -16, torque = 60}\n";
  };
  return "[[part]]\nname = \"ground\"\nchain = [[-20, 0], [18, 0], [18, 9]]\nfriction = 0.8\n" +
         PartText("cart", "box = [3.2, 0.6]\nposition = [0, 0.75]\ndensity = 2") +
         wheel("rear", "-1.1") + wheel("front", "1.1") +
         PartText("crate",
                  "box = [0.7, 0.7]\nposition = [5.6, 0.355]\ndensity = 0.5\nfriction = 0.3\n"
                  "repeat = {count = [" +
                      std::to_string(columns) + ", 3], step = [0.71, 0.71]}");
}

TEST(ExactLeftToEngine, AnExpensiveHeapIsLeftToTheEngineForAWhile) {
  const auto ours = SmallWorld(CartIntoCrates(5));
  const auto exact = SmallWorld(CartIntoCrates(5), kExactJoints);
  int left = 0, begun = 0, steps = 0;
  for (int tick = 0; tick < 300; ++tick) {
    ours->Step();
    exact->Step();
    EXPECT_TRUE(exact->Barrier().left.empty()) << "where it is asked for it is solved, at any cost";
    const std::vector<WorldSnapshot::Left> all = ours->Barrier().left;
    const int now = all.empty() ? 0 : all.front().steps;
    left += now > 0 ? 1 : 0;
    begun += now > steps ? 1 : 0;
    EXPECT_TRUE(now >= steps || now == steps - 1) << "each step of the engine's counts: " << tick;
    steps = now;
  }
  EXPECT_GT(left, 60);
  EXPECT_GE(left, 20 * begun) << "what one step found is not found anew after each barrier";
}

TEST(ExactLeftToEngine, AFewCratesAreSolvedExactly) {
  const auto world = SmallWorld(CartIntoCrates(1));
  for (int tick = 0; tick < 300; ++tick) {
    world->Step();
    EXPECT_TRUE(world->Barrier().left.empty()) << tick;
  }
  EXPECT_GT(world->Read(world->BodyOfId(1)).position.x(), 5) << "the cart is among them";
}

TEST(ExactLeftToEngine, AnAbandonedStepChangesNothing) {
  // The step in which it is found is the engine's, of the world as it was.
  const auto ours = SmallWorld(CartIntoCrates(5));
  bool found = false;
  for (int tick = 0; tick < 300 && !found; ++tick) {
    const WorldSnapshot before = ours->Barrier();
    ours->Step();
    found = before.left.empty() && !ours->Barrier().left.empty();
    if (!found) continue;
    const auto engines = SmallWorld(CartIntoCrates(5), "joints = \"iterative\"\n");
    ASSERT_TRUE(engines->Restore(before).ok());
    engines->Step();
    for (int body = 0; body < ours->body_count(); ++body) {
      EXPECT_EQ(ours->Read(body).position, engines->Read(body).position) << body;
      EXPECT_EQ(ours->Read(body).velocity, engines->Read(body).velocity) << body;
    }
  }
  EXPECT_TRUE(found);
}

/// Hashes by tick, with a barrier after each: the joints of each step are new, in memory full of
/// `byte`, as far as glibc allows (a sanitizer has its own). The engine does not initialise a new
/// rod's direction.
std::vector<std::uint64_t> HashesInMemoryFullOf(int byte) {
  const std::string trailer =
      PartText("trailer", "circle = 0.5\nposition = [-4, 0.5]\ndensity = 3") +
      "[[joint]]\nname = \"tow\"\nkind = \"distance\"\na = \"cart\"\nb = \"trailer\"\n"
      "anchor_a = [-1.5, 0.75]\nanchor_b = [-4, 0.5]\n";
  mallopt(M_PERTURB, 0xff ^ byte);
  const auto world = SmallWorld(CartIntoCrates(5) + trailer);
  std::vector<std::uint64_t> hashes;
  int left = 0;
  for (int tick = 0; tick < 200; ++tick) {
    world->Step();
    left += world->Barrier().left.empty() ? 0 : 1;
    hashes.push_back(world->Hash());
  }
  mallopt(M_PERTURB, 0);
  EXPECT_GT(left, 30) << "else they are solved exactly";
  return hashes;
}

TEST(ExactLeftToEngine, UninitialisedMemoryDoesNotAffectANewJoint) {
  // The bytes as floats: 0, 3.4e38, -1.2e-38 and NaN.
  const std::vector<std::uint64_t> zero = HashesInMemoryFullOf(0);
  for (const int byte : {0x7f, 0x80, 0xff}) {
    EXPECT_EQ(HashesInMemoryFullOf(byte), zero) << byte;
  }
}

}  // namespace exact_left_test
}  // namespace seam
