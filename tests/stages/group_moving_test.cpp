/// Grouping of bodies at rest against each other while all of them move.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/scene/grouping.h"
#include "tests/support/living_world.h"
#include "tests/support/scripted_world.h"
#include "tests/support/water_world.h"

namespace seam {
namespace group_moving_test {

using Eigen::Vector2d;

Scene Ungrouped(Scene scene) {
  scene.grouping.Set(Grouping{});
  return scene;
}

/// Most that a part is elsewhere than in the other world, m.
float Apart(const World& one, const World& other) {
  float most = 0;
  for (const Part& part : one.scene().parts) {
    const Vec2 apart = PartPose(one, part.id).position - PartPose(other, part.id).position;
    most = std::max(most, apart.norm());
  }
  return most;
}

/// Momentum of all bodies, kg m/s, and their angular momentum about the origin, kg m^2/s.
std::pair<Vector2d, double> MomentumOf(const World& world) {
  Vector2d momentum{0, 0};
  double angular = 0;
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    const MassPoint point = world.mass_point(body);
    const Vector2d velocity = state.velocity.cast<double>();
    const Vector2d centre =
        state.position.cast<double>() +
        Turned(point.centre.cast<double>().eval(), static_cast<double>(state.angle));
    const double mass = static_cast<double>(point.mass);
    momentum += mass * velocity;
    angular += mass * Cross(centre, velocity) +
               static_cast<double>(point.inertia) * static_cast<double>(state.spin);
  }
  return {momentum, angular};
}

TEST(MovingGroup, CratesOnARollingCartAreWithinATenthOfAMetreOfSingleOnesAfterAHardStop) {
  const Scene scene = LoadScene("scenes/freight.toml");
  ScriptedWorld grouped(scene), single(Ungrouped(scene));
  grouped.StepTo(200);
  single.StepTo(200);
  EXPECT_LE(grouped.world.body_count(), 10);
  EXPECT_EQ(single.world.body_count(), 64);
  EXPECT_GT(grouped.Read("cart").velocity.x(), 5);
  // Undone by the first tick of the brake.
  grouped.StepTo(302);
  single.StepTo(302);
  EXPECT_EQ(grouped.world.body_count(), 64);
  float most = 0;
  while (grouped.world.tick() < 530) {
    grouped.Step();
    single.Step();
    most = std::max(most, Apart(grouped.world, single.world));
  }
  EXPECT_LT(grouped.Read("cart").velocity.norm(), 0.01f) << "it has stopped";
  EXPECT_LT(most, 0.1f);
  EXPECT_LE(grouped.world.body_count(), 10) << "and is grouped again";
}

TEST(MovingGroup, TheKegMeetsSingleCrates) {
  ScriptedWorld run("freight");
  run.StepTo(540);
  EXPECT_LE(run.world.body_count(), 10);
  float keg = run.Read("keg").velocity.x();
  int bodies = 0;
  while (run.world.tick() < 640) {
    bodies = run.world.body_count();
    run.Step();
    const float now = run.Read("keg").velocity.x();
    if (run.world.tick() > 545 && now > keg + 0.5f) break;  // the blow
    keg = now;
  }
  EXPECT_LT(run.world.tick(), 640) << "it hits something";
  EXPECT_EQ(bodies, 64) << "before the blow";
}

/// Boxes at rest against each other, drifting and turning without gravity.
std::string Raft(float spin) {
  return "gravity = [0, 0]\n[solver]\nskin = 0.0025\nsleep = false\n[grouping]\nafter = 0.5\n"
         "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [0, 0]\nvelocity = [3, 1]\nspin = " +
         FloatDigits(static_cast<double>(spin)) + "\nrepeat = {count = 3, step = [1, 0]}\n";
}

TEST(MovingGroup, GroupingAndUngroupingKeepMomentum) {
  World world(ParseScene(Raft(0), "raft.toml"));
  std::vector<Edit> edits;
  while (edits.empty() && world.tick() < 200) {
    world.Step();
    edits = world.ProposeEdits();
  }
  ASSERT_EQ(edits.size(), 2u);
  const auto [momentum, angular] = MomentumOf(world);
  std::vector<Vec2> places;
  for (PartId part = 0; part < 3; ++part) places.push_back(PartPose(world, part).position);
  ASSERT_TRUE(world.Apply(edits));
  ASSERT_EQ(world.body_count(), 1);
  EXPECT_LT((MomentumOf(world).first - momentum).norm(), 1e-5);
  EXPECT_NEAR(MomentumOf(world).second, angular, 1e-4);
  for (PartId part = 0; part < 3; ++part) {
    const Vec2 moved = PartPose(world, part).position - places[static_cast<std::size_t>(part)];
    EXPECT_LT(moved.norm(), 1e-5f) << "they stay where they are";
  }
  // Spun faster than the limit, it is undone; each piece goes on as its place in the whole did.
  BodyState whole = world.Read(0);
  whole.spin = 0.8f;
  world.Write(0, whole);
  world.Step();
  edits = world.ProposeEdits();
  ASSERT_EQ(edits.size(), 2u);
  const BodyState before = world.Read(0);
  const MassPoint point = world.mass_point(0);
  const auto [turning, turning_angular] = MomentumOf(world);
  ASSERT_TRUE(world.Apply(edits));
  ASSERT_EQ(world.body_count(), 3);
  EXPECT_LT((MomentumOf(world).first - turning).norm(), 1e-5);
  EXPECT_NEAR(MomentumOf(world).second, turning_angular, 1e-4);
  const Vec2 centre = before.position + Turned(Vec2(point.centre.cast<float>()), before.angle);
  for (int body = 0; body < 3; ++body) {
    const BodyState piece = world.Read(body);
    const Vec2 arm = piece.position - centre;
    const Vec2 rigid = before.velocity + before.spin * Vec2(-arm.y(), arm.x());
    EXPECT_LT((piece.velocity - rigid).norm(), 1e-4f) << body;
    EXPECT_NEAR(piece.spin, before.spin, 1e-6f);
  }
}

/// Edits and hashes of a few ticks.
std::vector<std::pair<std::size_t, std::uint64_t>> Next(World* world, int ticks) {
  std::vector<std::pair<std::size_t, std::uint64_t>> all;
  for (int i = 0; i < ticks; ++i) {
    world->Step();
    const std::size_t found = world->ProposeEdits().size();
    all.emplace_back(found, world->Hash());
  }
  return all;
}

TEST(MovingGroup, AWorldThatGoesBackFindsTheSameEditsInTheSameTicks) {
  ScriptedWorld run("freight");
  run.StepTo(40);  // the crates have rested for half of their time
  const WorldSnapshot early = run.world.Barrier();
  const auto first = Next(&run.world, 60);
  EXPECT_GT(first.back().first, 0u) << "they would be grouped";
  ASSERT_TRUE(run.world.Restore(early).ok());
  EXPECT_EQ(Next(&run.world, 60), first);

  ScriptedWorld later("freight");
  later.StepTo(290);
  ASSERT_LE(later.world.body_count(), 10);
  later.world.SetInput(0, Input{});  // the brake
  const WorldSnapshot rolling = later.world.Barrier();
  const auto braked = Next(&later.world, 20);
  EXPECT_GT(braked.front().first, 0u) << "they would be undone";
  ASSERT_TRUE(later.world.Restore(rolling).ok());
  EXPECT_EQ(Next(&later.world, 20), braked);
}

/// A hull with a pile of crates between its rails rides on a swell of its own making.
std::string Ship() {
  std::string text = "[solver]\nskin = 0.0025\nsubsteps = 2\n[grouping]\nafter = 1\n" + Sea() +
                     "[[part]]\nname = \"hull\"\n"
                     "polygon = [[-5, 0.8], [-4.4, -1.2], [4.4, -1.2], [5, 0.8]]\n"
                     "position = [0, 0.3]\ndensity = 0.5\nfriction = 0.9\nvelocity = [2, 0]\n";
  for (int row = 0; row < 5; ++row) {
    const int count = 14 - row;
    text += "[[part]]\nname = \"row-" + std::to_string(row) + "\"\nbox = [0.6, 0.6]\nposition = [" +
            FloatDigits(-0.3 * (count - 1)) + ", " + FloatDigits(1.4 + 0.6 * row) +
            "]\ndensity = 0.2\nfriction = 0.8\nvelocity = [2, 0]\nrepeat = {count = " +
            std::to_string(count) + ", step = [0.6, 0]}\n";
  }
  return text;
}

TEST(MovingGroup, CargoOnAFloatingShipIsOneBodyWithIt) {
  const Scene scene = ParseScene(Ship(), "ship.toml");
  ScriptedWorld grouped(scene), single(Ungrouped(scene));
  float most = 0, lowest = 100, highest = -100;
  for (int tick = 1; tick <= 720; ++tick) {
    grouped.Step();
    single.Step();
    most = std::max(most, Apart(grouped.world, single.world));
    if (grouped.world.body_count() > 10) continue;
    lowest = std::min(lowest, grouped.Read("hull").position.y());
    highest = std::max(highest, grouped.Read("hull").position.y());
  }
  EXPECT_LE(grouped.world.body_count(), 10);
  EXPECT_EQ(single.world.body_count(), 61);
  EXPECT_GT(highest - lowest, 0.03f) << "it rises and sinks as one body";
  EXPECT_LT(most, 0.1f);
}

/// Crates on a sled that slides down a slope, whose box reaches as high as they are: one segment,
/// or one anchored box.
std::string Sled(double slope, bool chain) {
  const double c = std::cos(slope), s = std::sin(slope);
  const auto at = [&](double x, double y) {
    return "position = [" + FloatDigits(x * c - y * s) + ", " + FloatDigits(x * s + y * c) +
           "]\nangle = " + FloatDigits(slope) + "\n";
  };
  const std::string moving =
      "velocity = [" + FloatDigits(2 * c) + ", " + FloatDigits(2 * s) + "]\n";
  std::string text = "[solver]\nskin = 0.0025\nsubsteps = 2\n[grouping]\nafter = 1\n";
  text += "[[part]]\nname = \"slope\"\nfriction = 0\n";
  text += chain ? "chain = [[" + FloatDigits(-100 * c) + ", " + FloatDigits(-100 * s) + "], [" +
                      FloatDigits(100 * c) + ", " + FloatDigits(100 * s) + "]]\n"
                : "box = [200, 1]\nanchored = true\n" + at(0, -0.5);
  text += "[[part]]\nname = \"sled\"\nbox = [6, 0.8]\nfriction = 0.9\n" + at(0, 0.42) + moving;
  for (int row = 0; row < 3; ++row) {
    text += "[[part]]\nname = \"row-" + std::to_string(row) + "\"\nbox = [0.6, 0.6]\n" +
            at(-2.4 + 0.3 * row, 1.13 + 0.6 * row) + moving + "friction = 0.8\n" +
            "repeat = {count = " + std::to_string(9 - row) + ", step = [" + FloatDigits(0.6 * c) +
            ", " + FloatDigits(0.6 * s) + "]}\n";
  }
  return text;
}

TEST(MovingGroup, CargoIsOneBodyOnASlopeToo) {
  for (const double slope : {-0.03, -0.15, 0.1}) {
    for (const bool chain : {true, false}) {
      World world(ParseScene(Sled(slope, chain), "sled.toml"));
      Live(&world, 150);
      EXPECT_LE(world.body_count(), 2) << slope << (chain ? ", chain" : ", box");
      EXPECT_GT(world.Read(0).velocity.norm(), 0.3f) << "it slides";
    }
  }
}

TEST(MovingGroup, JammedBoxesAreNotGrouped) {
  // Twelve boxes of 1 m in 11.9 m: they cannot come to rest.
  auto world = SmallWorld(
      "[grouping]\nafter = 0.5\n[[part]]\nname = \"floor\"\nchain = [[-20, 0], [20, 0]]\n"
      "[[part]]\nname = \"wall\"\nbox = [1, 4]\nposition = [-6.45, 2]\nanchored = true\n"
      "repeat = {count = 2, step = [12.9, 0]}\n"
      "[[part]]\nname = \"box\"\nbox = [1, 1]\nposition = [-5.5, 0.52]\nfriction = 1\n"
      "repeat = {count = 12, step = [1, 0]}\n");
  Live(world.get(), 300);
  EXPECT_EQ(world->body_count(), 12);
  EXPECT_LT(world->Read(5).velocity.norm(), 0.05f) << "they stand still all the same";
}

}  // namespace group_moving_test
}  // namespace seam
