/// Bodies that an edit wakes: neighbours of what appears, leaves or changes.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "common/topology/edit.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace edit_wake_test {

/// A crate on something, or on something's end, 3 m above the ground; and another far away.
std::unique_ptr<ScriptedWorld> Sleeping(const std::string& parts) {
  auto run = std::make_unique<ScriptedWorld>(ParseScene(R"(
[[player]]
name = "ann"
[[part]]
name = "ground"
chain = [[-90, 0], [90, 0]]
[[part]]
name = "far"
box = [1, 1]
position = [40, 0.505]
)" + parts,
                                                        "test.toml"));
  for (int i = 0; i < 300; ++i) run->Step();
  EXPECT_FALSE(run->world.awake(run->Body("crate"))) << parts;
  EXPECT_FALSE(run->world.awake(run->Body("far"))) << parts;
  return run;
}

const std::string kCrate = R"(
[[part]]
name = "crate"
box = [1, 1]
position = [0, 3.715]
)";
const std::string kShelf = R"(
[[part]]
name = "shelf"
box = [4, 0.4]
position = [0, 3]
anchored = true
)" + kCrate;
const std::string kPost = R"(
[[part]]
name = "post"
box = [0.4, 0.4]
position = [0, 6]
anchored = true
group = -3
)" + kCrate;

PartId PartNamed(const World& world, const std::string& name) {
  for (const Part& part : world.scene().parts) {
    if (part.name == name) return part.id;
  }
  return -1;
}

Edit Removal(const World& world, const std::string& name) {
  return Edit(RemoveEdit{PartNamed(world, name)});
}

/// Applies the edit, and expects that it wakes the crate and not what is far away.
void ExpectWakes(const Edit& edit, ScriptedWorld* run) {
  ASSERT_TRUE(run->world.topology().Validate(edit).ok());
  run->world.Apply({edit});
  EXPECT_TRUE(run->world.awake(run->Body("crate")));
  EXPECT_FALSE(run->world.awake(run->Body("far")));
  for (int i = 0; i < 300; ++i) run->Step();
}

/// Expects that the crate falls to the ground.
void ExpectFalls(const Edit& edit, ScriptedWorld* run) {
  ExpectWakes(edit, run);
  EXPECT_LT(run->Read("crate").position.y(), 0.8);
}

TEST(EditWake, ASleeperFallsWhenItsSupportLeaves) {
  const auto run = Sleeping(kShelf);
  ExpectFalls(Removal(run->world, "shelf"), run.get());
}

TEST(EditWake, ASleeperFallsWhenTheCrateBelowItLeaves) {
  const auto run = Sleeping(kCrate + R"(
[[part]]
name = "below"
box = [2, 3.2]
position = [0, 1.605]
)");
  EXPECT_FALSE(run->world.awake(run->Body("below")));
  ExpectFalls(Removal(run->world, "below"), run.get());
}

TEST(EditWake, ASleeperFallsWhenItsJointOrTheOtherEndLeaves) {
  for (const char* joint : {"kind = \"distance\"", "kind = \"rope\"\nlength = 2.285",
                            "kind = \"hinge\"\nanchor = [0, 6]"}) {
    const std::string scene =
        kPost + "[[joint]]\nname = \"line\"\na = \"post\"\nb = \"crate\"\n" + joint + "\n";
    const auto cut = Sleeping(scene);
    ExpectFalls(Edit(BreakEdit{0}), cut.get());
    const auto uprooted = Sleeping(scene);
    ExpectFalls(Removal(uprooted->world, "post"), uprooted.get());
  }
}

/// Adjacent anchored boxes are one shape in the engine.
TEST(EditWake, OnlyTheBrickUnderASleeperWakesIt) {
  const auto run = Sleeping(kCrate + R"(
[[part]]
name = "row"
box = [2, 0.4]
position = [-40, 3]
anchored = true
repeat = {count = 40, step = [2, 0]}
)");
  run->world.Apply({Removal(run->world, "row.5")});
  EXPECT_FALSE(run->world.awake(run->Body("crate")));
  ExpectFalls(Removal(run->world, "row.20"), run.get());
}

/// Welded parts are one anchored assembly, which stays when one of them leaves.
TEST(EditWake, ASleeperFallsWhenItsPartOfAnAnchoredAssemblyLeaves) {
  const auto run = Sleeping(kShelf + R"(
[[part]]
name = "wall"
box = [0.4, 4]
position = [2.2, 3]
anchored = true
[[joint]]
name = "seam"
kind = "weld"
a = "wall"
b = "shelf"
)");
  ExpectFalls(Removal(run->world, "shelf"), run.get());
}

TEST(EditWake, APartThatAppearsInASleeperPushesItOut) {
  for (const char* depth : {"0.1", "0.6"}) {
    const auto run = Sleeping(kShelf);
    const std::string wall =
        std::string("[[part]]\nname = \"wall\"\nbox = [1, 1]\nanchored = true") + "\nposition = [" +
        std::to_string(std::stod(depth) - 1) + ", 3.705]\n";
    ExpectWakes(Edit(InsertEdit{wall}), run.get());
    EXPECT_GT(run->Read("crate").position.x(), 0.8 * std::stod(depth));
  }
}

TEST(EditWake, ABeltThatAppearsUnderASleeperCarriesIt) {
  const auto run = Sleeping(kShelf);
  ExpectWakes(Edit(InsertEdit{"[[part]]\nname = \"belt\"\nbox = [20, 0.4]\nanchored = true\n"
                              "position = [0, 3.02]\nconveyor = 2\n"}),
              run.get());
  EXPECT_GT(run->Read("crate").position.x(), 2);
}

TEST(EditWake, AJointThatAppearsAtASleeperActs) {
  const std::string ends = "[[joint]]\nname = \"line\"\na = \"post\"\nb = \"crate\"\n";
  for (const char* joint : {"kind = \"distance\"\nlength = 1.5", "kind = \"rope\"\nlength = 1.5"}) {
    const auto run = Sleeping(kShelf + kPost.substr(0, kPost.size() - kCrate.size()));
    ExpectWakes(Edit(InsertEdit{ends + joint}), run.get());
    EXPECT_GT(run->Read("crate").position.y(), 4.3) << joint;
  }
  const auto turned = Sleeping(kShelf + kPost.substr(0, kPost.size() - kCrate.size()));
  ExpectWakes(
      Edit(InsertEdit{ends + "kind = \"hinge\"\nanchor = [-3, 3.715]\nmotor = {speed = 0.5, "
                             "torque = 1000}\n"}),
      turned.get());
  EXPECT_GT(std::fabs(turned->Read("crate").position.x()), 1);
}

TEST(EditWake, AReplayAfterTheEditHasTheSameBits) {
  const auto run = Sleeping(kShelf);
  run->world.Apply({Removal(run->world, "shelf")});
  const WorldSnapshot barrier = run->world.Barrier();
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 120; ++i) {
    run->world.Step();
    hashes.push_back(run->world.Hash());
  }
  ASSERT_TRUE(run->world.Restore(barrier).ok());
  for (const std::uint64_t hash : hashes) {
    run->world.Step();
    ASSERT_EQ(run->world.Hash(), hash);
  }
}

/// A crate glued to a lift, in the middle of its way and of its turn.
TEST(EditWake, APartThatALiftReleasesGoesOnAsItDid) {
  ScriptedWorld run(ParseScene(R"(
gravity = [0, 0]
[[player]]
name = "ann"
[[part]]
name = "lift"
box = [4, 0.4]
position = [0, 3]
anchored = true
[[part]]
name = "crate"
box = [1, 1]
position = [1.5, 3.8]
[[joint]]
name = "way"
kind = "kinematic"
b = "lift"
path = [[0, 0], [6, 8]]
period = 10
turning = 0.4
[[joint]]
name = "bond"
kind = "glue"
a = "lift"
b = "crate"
strength = 0
)",
                               "test.toml"));
  for (int i = 0; i < 120; ++i) run.Step();
  run.world.Apply({Edit(BreakEdit{1})});
  const BodyState released = run.Read("crate");
  // The lift turns by 0.8 rad about its root, which goes 2 m/s along (0.6, 0.8).
  const Vec2 arm(1.5f * std::cos(0.8f) - 0.8f * std::sin(0.8f),
                 1.5f * std::sin(0.8f) + 0.8f * std::cos(0.8f));
  EXPECT_LT((released.position - Vec2(2.4f, 3 + 3.2f) - arm).norm(), 1e-4);
  EXPECT_LT((released.velocity - Vec2(1.2f, 1.6f) - 0.4f * Vec2(-arm.y(), arm.x())).norm(), 1e-4);
  EXPECT_NEAR(released.angle, 0.8, 1e-5);
  EXPECT_NEAR(released.spin, 0.4, 1e-5);
  for (int i = 0; i < 60; ++i) run.Step();
  EXPECT_LT((run.Read("crate").position - released.position - released.velocity).norm(), 1e-3);
}

}  // namespace edit_wake_test
}  // namespace seam
