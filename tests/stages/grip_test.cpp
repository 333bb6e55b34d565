/// Grips: a hand holds a touched body by a bond, which is an edit.

#include "common/topology/grip.h"

#include <gtest/gtest.h>

#include <fstream>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/sync/edits/edit_order.h"
#include "common/topology/topology_builder.h"
#include "common/topology/topology_fold.h"
#include "tests/support/character_world.h"

namespace seam {
namespace grip_test {

/// A pool with a ledge 0.35 m above the water, whose wall is at x = 0; the hero swims to it.
constexpr const char* kPool = R"(
[[part]]
name = "ground"
friction = 0.9
chain = [[-40, 0.35], [-20, 0.35], [-19.98, -3], [-0.02, -3], [0, 0.35], [60, 0.35]]
[[part]]
name = "crate"
box = [0.5, 0.5]
position = [30, 0.6]
[[water]]
name = "pool"
box = [20, 3]
position = [-10, -1.5]
)";

Scene PoolScene(const std::string& more = "grip = true\n") {
  return CharacterScene("position = [-1.3, -1.45]\nangle = -0.3\ndensity = 0.92\n" + more,
                        "[[0, {drive = 1.0}]]", kPool);
}

std::vector<int> GripsOf(const Scene& scene) {
  std::vector<int> grips;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    if (!scene.joints[j].gone && IsGrip(scene.joints[j])) grips.push_back(static_cast<int>(j));
  }
  return grips;
}

Vec2 TipOf(const World& world, PartId hand) {
  const BodyState arm = PartPose(world, hand);
  return arm.position + Turned(FingertipOf(world.scene(), hand).value(), arm.angle);
}

/// Largest distance between a fingertip and its held body over all grips, m.
float Apart(const World& world) {
  float apart = 0;
  for (const int index : GripsOf(world.scene())) {
    const Joint& joint = world.scene().joints[static_cast<std::size_t>(index)];
    const Part& held = world.scene().parts[static_cast<std::size_t>(joint.a)];
    const BodyState pose = PartPose(world, joint.a);
    const Vec2 local = Turned(Vec2(joint.anchor_a - held.position), -held.angle);
    const Vec2 point = pose.position + Turned(local, pose.angle);
    apart = std::max(apart, (point - TipOf(world, joint.b)).norm());
  }
  return apart;
}

/// Steps until a hand holds; at most 10 s.
bool StepUntilItHolds(ScriptedWorld* run) {
  while (GripsOf(run->world.scene()).empty() && run->world.tick() < 600) run->Step();
  return !GripsOf(run->world.scene()).empty();
}

TEST(Grip, ASwimmerHoldsAReachedWallByItsFingertip) {
  ScriptedWorld run(PoolScene());
  ASSERT_TRUE(StepUntilItHolds(&run));
  const Joint& grip =
      run.world.scene().joints[static_cast<std::size_t>(GripsOf(run.world.scene())[0])];
  const Character& hero = run.world.scene().characters[0];
  EXPECT_EQ(run.world.scene().parts[static_cast<std::size_t>(grip.a)].name, "ground");
  EXPECT_TRUE(grip.b == hero.parts[kLowerArmLeft] || grip.b == hero.parts[kLowerArmRight]);
  EXPECT_FLOAT_EQ(grip.strength, Look(run).mass * 10);
  EXPECT_NEAR(TipOf(run.world, grip.b).x(), 0, 0.25f);
  for (int tick = 0; tick < 10; ++tick) {
    run.Step();
    EXPECT_LT(Apart(run.world), 0.02f);
  }
}

TEST(Grip, HoldsTheTouchedTileAmongManyAnchoredOnes) {
  // Many anchored tiles share a body, placed elsewhere than each of them.
  ScriptedWorld run(CharacterScene(
      "position = [-1.3, -1.45]\nangle = -0.3\ndensity = 0.92\ngrip = true\n",
      "[[0, {drive = 1.0}]]",
      std::string(kPool) + "[[part]]\nname = \"tile\"\nbox = [0.1, 0.1]\nposition = [-0.05, -2.9]\n"
                           "anchored = true\nrepeat = {count = 33, step = [0, 0.1]}\n"));
  ASSERT_TRUE(StepUntilItHolds(&run));
  const Joint& grip =
      run.world.scene().joints[static_cast<std::size_t>(GripsOf(run.world.scene())[0])];
  const Part& tile = run.world.scene().parts[static_cast<std::size_t>(grip.a)];
  EXPECT_EQ(tile.name.substr(0, 4), "tile");
  EXPECT_NEAR(TipOf(run.world, grip.b).y(), tile.position.y(), 0.15f);
  EXPECT_LT(Apart(run.world), 0.05f);
}

TEST(Grip, HoldsNothingWithoutTheKey) {
  ScriptedWorld run(PoolScene(""));
  EXPECT_FALSE(StepUntilItHolds(&run));
}

TEST(Grip, ReleasesWithTheKeyAndAboveItsStrength) {
  ScriptedWorld pushed(PoolScene());
  ASSERT_TRUE(StepUntilItHolds(&pushed));
  pushed.world.SetInput(0, {});
  pushed.world.Step();
  for (const Edit& edit : pushed.world.ProposeEdits()) EXPECT_NE(edit.As<BreakEdit>(), nullptr);
  EXPECT_FALSE(pushed.world.ProposeEdits().empty());
  // Ten times its weight on the torso, away from the wall, for a tenth of a second.
  ScriptedWorld torn(PoolScene());
  ASSERT_TRUE(StepUntilItHolds(&torn));
  const PartId torso = torn.world.scene().characters[0].parts[kTorso];
  const float weight = Look(torn).mass * 10;
  bool broke = false;
  for (int tick = 0; tick < 12 && !broke; ++tick) {
    const auto before = GripsOf(torn.world.scene()).size();
    torn.world.Apply({Edit(PushEdit{torso, {-10 * weight / 60, 0}}, EditCause::kOutside)});
    torn.Step();
    broke = GripsOf(torn.world.scene()).size() < before;
  }
  EXPECT_TRUE(broke);
}

/// The hero's left hand on the crate.
BondEdit CrateGrip(const Scene& scene) {
  BondEdit bond;
  bond.a = 1;  // the crate
  bond.b = scene.characters[0].parts[kLowerArmLeft];
  bond.position = {-0.25f, 0.1f};
  bond.cause = BondCause::kGrip;
  bond.strength = GripStrength(scene, 0);
  return bond;
}

TEST(Grip, OnlyAHandWithGripMayHoldAndOnlyOneBodyAtATime) {
  const Scene scene = PoolScene();
  const BondEdit good = CrateGrip(scene);
  ASSERT_EQ(scene.parts[1].name, "crate");
  Topology topology(scene);
  EXPECT_TRUE(topology.Validate(Edit(good)).ok());
  std::vector<BondEdit> wrong(6, good);
  wrong[0].b = scene.characters[0].parts[kFootLeft];
  wrong[1].strength *= 2;
  wrong[2].strength = 0;
  wrong[3].a = scene.characters[0].parts[kHead];
  wrong[4].angle = 1;
  wrong[5].position = {5000, 0};
  for (const BondEdit& each : wrong) EXPECT_FALSE(topology.Validate(Edit(each)).ok());
  EXPECT_FALSE(Topology(PoolScene("")).Validate(Edit(good)).ok()) << "it has no grips";
  topology.Apply({Edit(good)});
  EXPECT_EQ(GripsOf(topology.scene()).size(), 1u);
  EXPECT_FALSE(topology.Validate(Edit(good)).ok()) << "the hand is full";
  // Both are one mechanism now, though not one body.
  const Composition& now = topology.composition();
  const auto mechanism = [&](PartId part) {
    const int assembly = now.assembly_of_part[static_cast<std::size_t>(part)];
    return now.assemblies[static_cast<std::size_t>(assembly)].mechanism;
  };
  EXPECT_EQ(mechanism(good.a), mechanism(good.b));
  EXPECT_NE(now.assembly_of_part[static_cast<std::size_t>(good.a)],
            now.assembly_of_part[static_cast<std::size_t>(good.b)]);
}

TEST(Grip, IsSentAndIsPartOfALatecomersTopology) {
  const Scene scene = PoolScene();
  const BondEdit grip = CrateGrip(scene);
  const Edit back = ToEdit(ToOrder(Edit(grip)));
  ASSERT_NE(back.As<BondEdit>(), nullptr);
  EXPECT_EQ(back.As<BondEdit>()->cause, BondCause::kGrip);
  Topology topology(scene);
  TopologyFold fold(topology);
  const auto apply = [&](const Edit& edit) {
    EXPECT_TRUE(topology.Apply({edit})[0].ok());
    fold.Note(edit, topology);
  };
  apply(back);
  // The elbow is severed: the lower arm still holds.
  apply(Edit(BreakEdit{scene.characters[0].joints[kElbowLeft]}));
  TopologyBuilder builder(scene);
  for (const TopologyEntry& entry : fold.Entries(topology)) {
    const Status status = builder.Add(entry);
    EXPECT_TRUE(status.ok()) << status.why();
  }
  ASSERT_TRUE(builder.Finish(topology.revision()).ok());
  const std::vector<int> made = GripsOf(builder.topology().scene());
  ASSERT_EQ(made, GripsOf(topology.scene()));
  ASSERT_EQ(made.size(), 1u);
  const Joint& one = topology.scene().joints[static_cast<std::size_t>(made[0])];
  const Joint& other = builder.topology().scene().joints[static_cast<std::size_t>(made[0])];
  EXPECT_EQ(one.anchor_a, other.anchor_a);
  EXPECT_EQ(one.anchor_b, other.anchor_b);
  EXPECT_EQ(one.strength, other.strength);
  EXPECT_EQ(one.collide, other.collide);
  EXPECT_EQ(builder.topology().composition().hash, topology.composition().hash);
}

TEST(Grip, ABarrierReplaysAClimbBitForBit) {
  ScriptedWorld run(PoolScene());
  ASSERT_TRUE(StepUntilItHolds(&run));
  for (int round = 0; round < 8; ++round) {
    for (int tick = 0; tick < 15; ++tick) run.Step();
    const WorldSnapshot snapshot = run.world.Barrier();
    const auto edits = run.world.topology().revision();
    std::vector<std::uint64_t> first;
    while (first.size() < 60 && run.world.topology().revision() == edits) {
      run.Step();
      if (run.world.topology().revision() == edits) first.push_back(run.world.Hash());
    }
    if (run.world.topology().revision() != edits) continue;  // others are made: no way back
    ASSERT_TRUE(run.world.Restore(snapshot).ok());
    for (const std::uint64_t hash : first) {
      run.Step();
      ASSERT_EQ(run.world.Hash(), hash) << round;
    }
  }
}

}  // namespace grip_test
}  // namespace seam
