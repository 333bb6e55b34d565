/// Going back in time: after a barrier, restoring and stepping again gives the same bits.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "tests/support/scripted_world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace {

/// Runs `ticks` of a scene with a barrier every `every`, goes back to each barrier in turn and does
/// again what came after it. The number of ticks whose hash was another one then.
int DifferentTicks(const Scene& scene, int ticks, int every, int again) {
  World world(scene);
  std::vector<std::uint64_t> hashes = {world.Hash()};
  std::vector<WorldSnapshot> barriers;
  for (int t = 1; t <= ticks; ++t) {
    world.Step();
    if (t % every == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  int different = 0;
  for (const WorldSnapshot& barrier : barriers) {
    world.Restore(barrier);
    if (world.Hash() != hashes[static_cast<std::size_t>(barrier.tick)]) ++different;
    for (int i = 1; i <= again && world.tick() < ticks; ++i) {
      world.Step();
      if (world.tick() % every == 0) world.Barrier();
      if (world.Hash() != hashes[static_cast<std::size_t>(world.tick())]) ++different;
    }
  }
  return different;
}

TEST(Snapshot, ReplayIsBitExactWithContactsJointsMotorsAndSleep) {
  for (const char* name : {"wall", "stack", "cradle", "crossing"}) {
    const Scene scene = LoadScene(std::string("scenes/") + name + ".toml");
    EXPECT_EQ(DifferentTicks(scene, 300, 2, 20), 0) << name;
    EXPECT_EQ(DifferentTicks(scene, 300, 30, 60), 0) << name;
  }
}

TEST(Snapshot, WithoutTheBarrierAReplayGoesAnotherWay) {
  // The reason for it: if this ever fails, the barrier can go.
  const Scene scene = LoadScene("scenes/wall.toml");
  ScriptedWorld live(scene), other(scene);
  live.StepTo(240);  // the bricks fly and lie about
  other.StepTo(240);
  const WorldSnapshot then = other.world.Barrier();
  EXPECT_EQ(live.world.Hash(), other.world.Hash()) << "a barrier changes no state";
  live.StepTo(300);
  other.StepTo(300);
  EXPECT_NE(live.world.Hash(), other.world.Hash());
  other.world.Restore(then);
  EXPECT_EQ(other.world.tick(), 240);
}

/// A pile at rest under a barrier every tick.
const char* kPile =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
    "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
    "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [0.1, 1.5]\n"
    "[[part]]\nname = \"c\"\nbox = [1, 1]\nposition = [0, 2.5]\n"
    "[[part]]\nname = \"d\"\nbox = [1, 1]\nposition = [0.1, 3.5]\n";

TEST(Snapshot, BarriersKeepWhatHoldsAPileUpAndLetItSleep) {
  World world(ParseScene(kPile, "pile.toml")), plain(ParseScene(kPile, "pile.toml"));
  int asleep_at = -1, plain_asleep_at = -1;
  for (int t = 1; t <= 240; ++t) {
    world.Step();
    world.Barrier();
    plain.Step();
    if (asleep_at < 0 && !world.awake(3)) asleep_at = t;
    if (plain_asleep_at < 0 && !plain.awake(3)) plain_asleep_at = t;
  }
  ASSERT_GT(asleep_at, 30) << "half a second of rest is asked for";
  EXPECT_NEAR(asleep_at, plain_asleep_at, 15);
  for (int body = 0; body < 4; ++body) {
    EXPECT_NEAR(world.Read(body).position.y(), plain.Read(body).position.y(), 2e-3) << body;
    EXPECT_NEAR(world.Read(body).position.x(), plain.Read(body).position.x(), 2e-3) << body;
  }
}

TEST(Snapshot, ABarrierChangesNothingWhereNothingTouches) {
  const char* flight =
      "[[part]]\nname = \"a\"\nbox = [1, 0.5]\nposition = [0, 5]\n"
      "velocity = [3, 8]\nspin = 4\n";
  World world(ParseScene(flight, "flight.toml")), plain(ParseScene(flight, "flight.toml"));
  for (int t = 1; t <= 120; ++t) {
    world.Step();
    world.Barrier();
    plain.Step();
    ASSERT_EQ(world.Hash(), plain.Hash()) << t;
  }
}

TEST(Snapshot, KinematicBodiesAndMotorsStayAsTheyAre) {
  const Scene scene = LoadScene("scenes/crossing.toml");
  World world(scene);
  world.SetInput(0, Input{127, 0, 0});
  world.SetMotion(2, Motion::kKinematic);
  Steps(&world, 30);
  world.Barrier();
  EXPECT_EQ(world.motion(2), Motion::kKinematic);
  EXPECT_EQ(world.motion(0), Motion::kDynamic);
  const float before = world.Read(0).position.x();
  Steps(&world, 60);
  EXPECT_GT(std::fabs(world.Read(0).position.x() - before), 1) << "it goes on driving";
}

TEST(Snapshot, SaysWhatABarrierCosts) {
  for (const char* name : {"crossing", "wall", "stack"}) {
    ScriptedWorld s{std::string(name)};
    s.StepTo(60);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) s.world.Barrier();
    const std::chrono::duration<double> barriers = std::chrono::steady_clock::now() - begin;
    const auto middle = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) s.Step();
    const std::chrono::duration<double> steps = std::chrono::steady_clock::now() - middle;
    std::printf("[          ] %s, %d bodies: barrier %.1f us, step %.1f us\n", name,
                s.world.body_count(), barriers.count() * 5000, steps.count() * 5000);
    EXPECT_EQ(s.world.tick(), 260);
  }
}

}  // namespace
}  // namespace seam
