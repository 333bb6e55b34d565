/// Going back in time: after a barrier, restoring and stepping again gives the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "common/base/state_archive.h"
#include "common/physics/saved/world_saved.h"
#include "tests/support/scripted_world.h"
#include "tests/support/small_world.h"

namespace seam {
namespace world_snapshot_test {

/// Runs `ticks` of a scene with a barrier every `every`, goes back to each barrier in turn and
/// replays. Returns the number of ticks with a different hash.
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
    EXPECT_TRUE(world.Restore(barrier).ok());
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

TEST(Snapshot, WithoutTheBarrierAReplayDiverges) {
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
  EXPECT_TRUE(other.world.Restore(then).ok());
  EXPECT_EQ(other.world.tick(), 240);
}

/// A cart that its player does not drive, asleep on the ground.
const char* kCart = R"([[player]]
name = "ann"
[[part]]
name = "ground"
chain = [[-50, 0], [50, 0]]
[[part]]
name = "cart"
box = [2, 0.4]
position = [0, 0.6]
owner = "ann"
[[part]]
name = "wheel"
circle = 0.3
position = [-0.7, 0.3]
repeat = {count = 2, step = [1.4, 0]}
[[joint]]
name = "axle"
kind = "hinge"
a = "cart"
b = "wheel.0"
anchor = [-0.7, 0.3]
motor = {player = "ann", speed = -6, torque = 5}
[[joint]]
name = "other"
kind = "hinge"
a = "cart"
b = "wheel.1"
anchor = [0.7, 0.3]
)";

TEST(Snapshot, GoingBackFromADriveToBeforeItWakesNothing) {
  World world(ParseScene(kCart, "cart.toml"));
  Input drive;
  drive.drive = 100;
  for (int t = 0; t < 600 && world.awake(0); ++t) {
    world.SetInput(0, Input{});
    world.Step();
  }
  ASSERT_FALSE(world.awake(0));
  const WorldSnapshot before = world.Barrier();
  world.SetInput(0, Input{});
  world.Step();
  const std::uint64_t hash = world.Hash();
  world.SetInput(0, drive);
  world.Step();
  ASSERT_TRUE(world.awake(0)) << "it is driven, or the test shows nothing";
  ASSERT_TRUE(world.Restore(before).ok());
  world.SetInput(0, Input{});
  world.Step();
  EXPECT_FALSE(world.awake(0)) << "the same input as before changes nothing";
  EXPECT_EQ(world.Hash(), hash);
}

/// A pile at rest under a barrier every tick.
const char* kPile =
    "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n"
    "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
    "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [0.1, 1.5]\n"
    "[[part]]\nname = \"c\"\nbox = [1, 1]\nposition = [0, 2.5]\n"
    "[[part]]\nname = \"d\"\nbox = [1, 1]\nposition = [0.1, 3.5]\n";

TEST(Snapshot, BarriersKeepAPilesContactsAndLetItSleep) {
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

TEST(Snapshot, ABarrierChangesNothingWithoutContacts) {
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
  world.SetActivity(2, Activity::kKinematic);
  Steps(&world, 30);
  world.Barrier();
  EXPECT_EQ(world.activity(2), Activity::kKinematic);
  EXPECT_EQ(world.activity(0), Activity::kSimulated);
  const float before = world.Read(0).position.x();
  Steps(&world, 60);
  EXPECT_GT(std::fabs(world.Read(0).position.x() - before), 1) << "it goes on driving";
}

/// Two boxes that are one, two on a hinge, and one on a rope from the ceiling.
const char* kBound =
    "[[part]]\nname = \"ceiling\"\nbox = [20, 1]\nposition = [0, 9]\nanchored = true\n"
    "[[part]]\nname = \"a\"\nbox = [1, 1]\nposition = [0, 0]\n"
    "[[part]]\nname = \"b\"\nbox = [1, 1]\nposition = [1, 0]\n"
    "[[part]]\nname = \"c\"\nbox = [1, 1]\nposition = [5, 0]\n"
    "[[part]]\nname = \"d\"\nbox = [1, 1]\nposition = [6, 0]\n"
    "[[part]]\nname = \"e\"\nbox = [1, 1]\nposition = [-5, 3]\n"
    "[[joint]]\nname = \"weld\"\nkind = \"weld\"\na = \"a\"\nb = \"b\"\n"
    "[[joint]]\nname = \"hinge\"\nkind = \"revolute\"\na = \"c\"\nb = \"d\"\nanchor = [5.5, 0]\n"
    "[[joint]]\nname = \"rope\"\nkind = \"distance\"\na = \"ceiling\"\nb = \"e\"\n"
    "anchor_a = [-5, 8.5]\nanchor_b = [-5, 3.5]\n";

TEST(Snapshot, RestoreAcrossABrokenJointIsRefusedAndChangesNothing) {
  for (const std::int32_t joint : {0, 1, 2}) {
    World world(ParseScene(kBound, "bound.toml"));
    Steps(&world, 10);
    const WorldSnapshot before = world.Barrier();
    EXPECT_TRUE(world.Restore(before).ok());
    Steps(&world, 5);
    ASSERT_TRUE(world.Apply({Edit{BreakEdit{joint}}}).has_value()) << joint;
    const std::uint64_t hash = world.Hash();
    const Status back = world.Restore(before);
    EXPECT_FALSE(back.ok()) << joint;
    EXPECT_NE(back.why().find("cannot go back to tick 10"), std::string::npos) << back.why();
    EXPECT_EQ(back.why().find('\n'), std::string::npos);
    EXPECT_EQ(world.Hash(), hash);
    EXPECT_EQ(world.tick(), 15);
    Steps(&world, 5);
    EXPECT_TRUE(world.Restore(world.Barrier()).ok()) << "a new one is good";
  }
}

TEST(Snapshot, RestoreAcrossAnInsertIsRefusedAndAcrossAPushItGoesBack) {
  World world(ParseScene(kBound, "bound.toml"));
  const WorldSnapshot before = world.Barrier();
  const std::uint64_t hash = world.Hash();
  PushEdit push;
  push.part = 1;
  push.impulse = Vec2(3, 0);
  EXPECT_FALSE(world.Apply({Edit{push}}).has_value());
  EXPECT_NE(world.Hash(), hash);
  EXPECT_TRUE(world.Restore(before).ok());
  EXPECT_EQ(world.Hash(), hash);
  InsertEdit insert;
  insert.text = "[[part]]\nname = \"new\"\nbox = [1, 1]\nposition = [12, 0]\n";
  ASSERT_TRUE(world.Apply({Edit{insert}}).has_value());
  EXPECT_FALSE(world.Restore(before).ok());
}

TEST(Snapshot, PrintsTheCostOfABarrier) {
  for (const char* name : {"crossing", "wall", "stack"}) {
    ScriptedWorld s{std::string(name)};
    s.StepTo(60);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) EXPECT_TRUE(s.world.Restore(s.world.Barrier()).ok());
    const std::chrono::duration<double> barriers = std::chrono::steady_clock::now() - begin;
    const auto middle = std::chrono::steady_clock::now();
    for (int i = 0; i < 200; ++i) s.Step();
    const std::chrono::duration<double> steps = std::chrono::steady_clock::now() - middle;
    std::printf("[          ] %s, %d bodies: barrier %.1f us, step %.1f us\n", name,
                s.world.body_count(), barriers.count() * 5000, steps.count() * 5000);
    EXPECT_EQ(s.world.tick(), 260);
  }
}

/// Steps a world with a barrier every other tick. `twice`: takes each twice; `times` gets the
/// times of the first and of the second ones, us.
std::vector<std::uint64_t> HashesWithBarriers(const Scene& scene, bool twice,
                                              std::array<std::vector<double>, 2>* times) {
  ScriptedWorld s(scene);
  std::vector<std::uint64_t> hashes;
  for (int t = 1; t <= 240; ++t) {
    s.Step();
    for (std::size_t i = 0; t % 2 == 0 && i < (twice ? 2 : 1); ++i) {
      const auto begin = std::chrono::steady_clock::now();
      s.world.Barrier();
      const std::chrono::duration<double, std::micro> took =
          std::chrono::steady_clock::now() - begin;
      (*times)[i].push_back(took.count());
    }
    hashes.push_back(s.world.Hash());
  }
  return hashes;
}

/// A pause of the whole program, which may take as long as all barriers, does not change it.
double Median(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

TEST(Snapshot, ASecondBarrierInATickChangesNothingAndCostsLess) {
  for (const char* name : {"wall", "heap", "seesaw", "playground"}) {
    const Scene scene = LoadScene(std::string("scenes/") + name + ".toml");
    std::array<std::vector<double>, 2> once_us, times;
    const std::vector<std::uint64_t> once = HashesWithBarriers(scene, false, &once_us);
    EXPECT_EQ(HashesWithBarriers(scene, true, &times), once) << name;
    const double first_us = Median(times[0]), second_us = Median(times[1]);
    std::printf("%s: a barrier takes %.0f us, another one in the same tick %.0f\n", name, first_us,
                second_us);
    EXPECT_LT(second_us, 0.8 * first_us) << name;
  }
}

TEST(Snapshot, ABarrierAfterAWriteIsBuiltAnew) {
  const Scene scene = LoadScene("scenes/wall.toml");
  ScriptedWorld live(scene), other(scene);
  for (ScriptedWorld* each : {&live, &other}) {
    each->StepTo(100);
    each->world.Barrier();
    BodyState moved = each->world.Read(3);
    moved.position.x() += 0.01f;
    each->world.Write(3, moved);
  }
  const WorldSnapshot barrier = live.world.Barrier();
  ASSERT_TRUE(other.world.Restore(other.world.Keep()).ok());
  for (int t = 0; t < 60; ++t) {
    live.world.Step();
    other.world.Step();
    ASSERT_EQ(live.world.Hash(), other.world.Hash()) << t;
  }
}

TEST(Snapshot, ASeriesIsReadAsItWasWrittenInFewBytesAtRest) {
  for (const char* name : {"wall", "heap", "seesaw"}) {
    ScriptedWorld s{std::string(name)};
    StateArchive out;
    WorldSnapshot before;
    std::vector<WorldSnapshot> all;
    std::size_t alone = 0;
    for (int t = 0; t < 300; t += 10) {
      s.StepTo(t);
      all.push_back(s.world.Barrier());
      PersistAfter(out, before, &all.back());
      before = all.back();
      StateArchive one;
      Persist(one, &before);
      alone += one.Take().size();
    }
    const Bytes bytes = out.Take();
    std::printf("%s: %zu bytes instead of %zu\n", name, bytes.size(), alone);
    EXPECT_LE(bytes.size(), alone);
    StateArchive in(bytes);
    before = WorldSnapshot();
    for (const WorldSnapshot& was : all) {
      WorldSnapshot is;
      PersistAfter(in, before, &is);
      ASSERT_TRUE(in.ok()) << in.status().why();
      ASSERT_EQ(is.points.size(), was.points.size());
      StateArchive x, y;
      WorldSnapshot copy = was;
      Persist(x, &copy);
      Persist(y, &is);
      ASSERT_EQ(x.Take(), y.Take()) << name << " " << was.tick;
      before = is;
    }
    EXPECT_EQ(in.left(), 0u);
  }
}

}  // namespace world_snapshot_test
}  // namespace seam
