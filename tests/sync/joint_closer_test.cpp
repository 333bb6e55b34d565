/// Poses with closed joints, and their remaining error.

#include "common/sync/show/joint_closer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/base/random.h"
#include "common/measure/joint_drift.h"
#include "tests/support/small_world.h"

namespace seam {
namespace joint_closer_test {

std::string Box(const std::string& name, double x, const std::string& more = "") {
  return "[[part]]\nname = \"" + name + "\"\nbox = [0.8, 0.2]\nposition = [" + FloatDigits(x) +
         ", 0]\n" + more + "\n";
}

std::string Between(const std::string& a, const std::string& b, double x, const std::string& rest) {
  return "[[joint]]\nname = \"" + a + b + "\"\na = \"" + a + "\"\nb = \"" + b + "\"\nanchor = [" +
         FloatDigits(x) + ", 0]\n" + rest + "\n";
}

/// One joint between two boxes, of every kind that holds something, and a chain to an anchor.
std::vector<std::string> AllKinds() {
  std::vector<std::string> scenes;
  for (const char* kind :
       {"kind = \"revolute\"", "kind = \"revolute\"\nlimits = [-0.2, 0.3]",
        "kind = \"weld\"\nfrequency = 3\ndamping_ratio = 0.5",
        "kind = \"wheel\"\naxis = [0, 1]\nfrequency = 3\ndamping_ratio = 0.5\nlimits = [-0.1, 0.1]",
        "kind = \"wheel\"\naxis = [0, 1]",
        "kind = \"prismatic\"\naxis = [1, 0]\nlimits = [-1, 0.2]"}) {
    scenes.push_back(Box("a", 0) + Box("b", 1, "density = 5") + Between("a", "b", 0.5, kind));
  }
  for (const char* kind : {"rope", "distance"}) {
    scenes.push_back(Box("a", 0) + Box("b", 2, "density = 5") +
                     "[[joint]]\nname = \"ab\"\na = \"a\"\nb = \"b\"\nanchor_a = [0.4, 0]\n" +
                     "anchor_b = [1.6, 0]\nlength = 1.2\nkind = \"" + kind + "\"\n");
  }
  std::string chain = Box("post", -1, "anchored = true");
  std::string before = "post";
  for (int i = 0; i < 12; ++i) {
    const std::string name = "link" + std::to_string(i);
    chain += Box(name, i) + Between(before, name, i - 0.5, "kind = \"revolute\"");
    before = name;
  }
  scenes.push_back(chain);
  return scenes;
}

/// Each body moved by up to `shift` m and turned by up to a third of that in rad.
std::vector<BodyState> Torn(const World& world, double shift) {
  Random random(5);
  std::vector<BodyState> poses;
  for (int body = 0; body < world.body_count(); ++body) {
    BodyState pose = world.Read(body);
    pose.position.x() += static_cast<float>(random.Uniform(-shift, shift));
    pose.position.y() += static_cast<float>(random.Uniform(-shift, shift));
    pose.angle += static_cast<float>(random.Uniform(-shift, shift) / 3);
    poses.push_back(pose);
  }
  return poses;
}

TEST(JointCloser, ClosesEveryKindOfJoint) {
  for (const std::string& text : AllKinds()) {
    const auto world = SmallWorld(text);
    const JointMeter meter(world->scene(), world->composition());
    std::vector<BodyState> poses = Torn(*world, 0.2);
    poses.back().position.x() += 0.5f;  // a rope can only be too long
    EXPECT_GT(meter.Worst(poses), 0.01) << text;
    JointCloser(*world).Close(0, false, &poses);
    EXPECT_LT(meter.Worst(poses), 3e-3) << text;
  }
}

TEST(JointCloser, ClosesTwoSlidesWithALightCross) {
  // The second slide takes hold two metres from the centre of the cross, which is turned by it.
  const auto world = SmallWorld(
      "[[part]]\nname = \"post\"\nbox = [0.2, 0.2]\nposition = [0, 0]\nanchored = true\n"
      "[[part]]\nname = \"cross\"\nbox = [0.3, 0.3]\nposition = [0.5, 0]\ndensity = 0.2\n"
      "[[part]]\nname = \"mallet\"\ncircle = 0.4\nposition = [0.5, 2]\ndensity = 3\n"
      "[[joint]]\nname = \"x\"\nkind = \"prismatic\"\na = \"post\"\nb = \"cross\"\n"
      "axis = [1, 0]\nlimits = [-2, 2]\n"
      "[[joint]]\nname = \"y\"\nkind = \"prismatic\"\na = \"cross\"\nb = \"mallet\"\n"
      "axis = [0, 1]\nlimits = [-2, 2]\n");
  const JointMeter meter(world->scene(), world->composition());
  const JointCloser joints(*world);
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    std::vector<BodyState> poses = {world->Read(0), world->Read(1)};
    for (BodyState& pose : poses) {
      pose.position.x() += static_cast<float>(random.Uniform(-0.2, 0.2));
      pose.position.y() += static_cast<float>(random.Uniform(-0.2, 0.2));
      pose.angle += static_cast<float>(random.Uniform(-0.1, 0.1));
    }
    joints.Close(0, false, &poses);
    EXPECT_LT(meter.Worst(poses), 2e-4) << i;
  }
}

TEST(JointCloser, AWeldKeepsItsAngleAndAHingeItsLimits) {
  const auto weld = SmallWorld(
      Box("a", 0) + Box("b", 1) + Between("a", "b", 0.5, "kind = \"weld\""), "welds = \"joint\"");
  std::vector<BodyState> poses = Torn(*weld, 0.6);
  ASSERT_EQ(poses.size(), 2u);
  JointCloser(*weld).Close(0, false, &poses);
  EXPECT_NEAR(poses[0].angle, poses[1].angle, 1e-3);

  const auto hinge =
      SmallWorld(Box("a", 0) + Box("b", 1) +
                 Between("a", "b", 0.5, "kind = \"revolute\"\nlimits = [-0.2, 0.3]"));
  poses = Torn(*hinge, 0);
  poses[1].angle += 1;
  JointCloser(*hinge).Close(0, false, &poses);
  EXPECT_LT(poses[1].angle - poses[0].angle, 0.301);
  EXPECT_GT(poses[1].angle - poses[0].angle, 0);
}

TEST(JointCloser, RemovesWholeTurnsFromALimitedHinge) {
  std::string scene = Box("a", 0);
  for (int i = 0; i < 3; ++i) {
    const std::string before(1, static_cast<char>('a' + i)), next(1, static_cast<char>('b' + i));
    scene += Box(next, i + 1) +
             Between(before, next, i + 0.5,
                     std::string("kind = \"hinge\"\n") + (i < 2 ? "limits = [-1, 1]" : ""));
  }
  const auto world = SmallWorld(scene);
  const JointCloser joints(*world);
  std::vector<BodyState> poses;
  for (int body = 0; body < 4; ++body) poses.push_back(world->Read(body));
  const float turn = 2 * kPiFloat;
  poses[0].angle = 3.0f;
  poses[1].angle = 3.6f - turn;  // as the wire has it
  poses[2].angle = 3.2f + 2 * turn;
  poses[3].angle = 40;
  joints.Unwind(0, &poses);
  EXPECT_EQ(poses[0].angle, 3.0f);
  EXPECT_NEAR(poses[1].angle, 3.6f, 1e-5);
  EXPECT_NEAR(poses[2].angle, 3.2f, 1e-5);
  EXPECT_EQ(poses[3].angle, 40) << "it may turn freely";
}

TEST(JointCloser, KeepsTheCentreOfMassAndMovesTheLightBody) {
  const auto world = SmallWorld(Box("a", 0) + Box("b", 1, "density = 5") +
                                Between("a", "b", 0.5, "kind = \"revolute\""));
  std::vector<BodyState> poses = Torn(*world, 0);
  poses[0].position.y() = 0.6f;
  const std::vector<BodyState> torn = poses;
  JointCloser(*world).Close(0, false, &poses);
  Vec2 moment(0, 0);
  for (int body = 0; body < 2; ++body) {
    const auto b = static_cast<std::size_t>(body);
    moment += world->mass(body) * (poses[b].position - torn[b].position);
  }
  EXPECT_LT(moment.norm(), 1e-4f * world->mass(0));
  EXPECT_GT((poses[0].position - torn[0].position).norm(),
            3 * (poses[1].position - torn[1].position).norm());
}

TEST(JointCloser, LeavesClosedJointsBitForBit) {
  for (const std::string& text : AllKinds()) {
    const auto world = SmallWorld(text);
    std::vector<BodyState> poses = Torn(*world, 0);
    JointCloser(*world).Close(0, false, &poses);
    for (int body = 0; body < world->body_count(); ++body) {
      const BodyState before = world->Read(body);
      EXPECT_EQ(poses[static_cast<std::size_t>(body)].position, before.position);
      EXPECT_EQ(poses[static_cast<std::size_t>(body)].angle, before.angle);
    }
  }
}

/// A hinge that stands open by 5 cm in the world stays so where it is simulated, and is closed
/// where it is only displayed.
TEST(JointCloser, LeavesOpenAJointThatTheEngineLeavesOpen) {
  const auto world =
      SmallWorld(Box("a", 0) + Box("b", 1) + Between("a", "b", 0.5, "kind = \"revolute\""));
  BodyState b = world->Read(1);
  b.position.x() += 0.05f;
  world->Write(1, b);  // the engine has not had a step to close it
  const JointMeter meter(world->scene(), world->composition());
  JointCloser joints(*world);
  std::vector<BodyState> poses = Torn(*world, 0);
  joints.Close(0, false, &poses);
  EXPECT_LT(meter.Worst(poses), 0.001);
  poses = Torn(*world, 0);
  joints.Close(0, true, &poses);
  EXPECT_NEAR(meter.Worst(poses), 0.05, 1e-4);
}

}  // namespace joint_closer_test
}  // namespace seam
