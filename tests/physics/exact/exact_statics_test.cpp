/// The forces that joints hold, by arithmetic.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "tests/physics/exact/exact_scenes.h"
#include "tests/support/living_world.h"

namespace seam {
namespace exact_statics_test {

/// A hook of 0.4 kg glued to a wall, from which `links` of 0.2 kg hang in a row.
std::string HungFromGlue(double strength, int links) {
  std::string text =
      "[[part]]\nname = \"wall\"\nbox = [1, 1]\nposition = [-0.7, 0]\nanchored = true\n" +
      PartText("hook", "box = [0.4, 1]\nposition = [0, 0]") +
      "[[joint]]\nname = \"glue\"\nkind = \"glue\"\na = \"wall\"\nb = \"hook\"\n"
      "anchor = [-0.2, 0]\nstrength = " +
      FloatDigits(strength) + "\n" +
      PartText("link", "box = [0.2, 1]\nposition = [0, -1]\nrepeat = {count = " +
                           std::to_string(links) + ", step = [0, -1]}");
  text += HingeText("h", "hook", "link.0", 0, -0.5);
  for (int i = 0; i + 1 < links; ++i) {
    text += HingeText("h" + std::to_string(i), "link." + std::to_string(i),
                      "link." + std::to_string(i + 1), 0, -1.5 - i);
  }
  return text;
}

TEST(ExactStatics, AnAnchorBreaksAtItsStrengthAndNotTwoPercentBelow) {
  // 0.4 + 5 * 0.2 kg at 10 m/s2. Iterations would need time to find the sum of all links.
  const double load = 14;
  for (const char* solver :
       {"", "substeps = 3\n", "joint_substeps = 1\n", "joint_substeps = 5\n"}) {
    auto holds = ExactWorld(HungFromGlue(1.02 * load, 5), solver);
    EXPECT_TRUE(Live(holds.get(), 120).empty()) << solver;
    auto breaks = ExactWorld(HungFromGlue(0.999 * load, 5), solver);
    EXPECT_EQ(Live(breaks.get(), 3).size(), 1u) << solver;
  }
}

TEST(ExactStatics, ASwingingLoadAddsCentripetalForceToItsAnchor) {
  // Let go level with the hinge, a point mass on a rod would pull with 3 m g at the bottom; a rod
  // of 2 m with its mass spread pulls with 2.5 m g there: m g + m w^2 l/2 with w^2 = 3 g / l.
  const double load = 0.2 * 10 * 2.5 + 0.0016 * 10;  // and the hook's own
  const auto swing = [](double strength) {
    return "[[part]]\nname = \"wall\"\nbox = [1, 1]\nposition = [-0.7, 0]\nanchored = true\n" +
           PartText("hook", "box = [0.4, 0.4]\nposition = [0, 0]\ndensity = 0.01\ngroup = -1") +
           "[[joint]]\nname = \"glue\"\nkind = \"glue\"\na = \"wall\"\nb = \"hook\"\n"
           "anchor = [-0.2, 0]\nstrength = " +
           FloatDigits(strength) + "\n" +
           PartText("rod", "box = [2, 0.1]\nposition = [1, 0]\ngroup = -1") +
           HingeText("h", "hook", "rod", 0, 0);
  };
  auto holds = ExactWorld(swing(1.02 * load));
  EXPECT_TRUE(Live(holds.get(), 240).empty());
  auto breaks = ExactWorld(swing(0.98 * load));
  EXPECT_EQ(Live(breaks.get(), 120).size(), 1u);
}

/// A hook of 0.4 kg glued to a wall, and a load of 1 kg on a joint to it. The joint's keys.
bool TearsOff(double strength, const std::string& joint) {
  auto world = ExactWorld(
      "[[part]]\nname = \"wall\"\nbox = [1, 1]\nposition = [-0.7, 0]\nanchored = true\n" +
      PartText("hook", "box = [0.4, 1]\nposition = [0, 0]") +
      "[[joint]]\nname = \"glue\"\nkind = \"glue\"\na = \"wall\"\nb = \"hook\"\n"
      "anchor = [-0.2, 0]\nstrength = " +
      FloatDigits(strength) + "\n" + PartText("load", "box = [1, 1]\nposition = [0, -2]") +
      "[[joint]]\nname = \"j\"\na = \"hook\"\nb = \"load\"\n" + joint + "\n");
  return !Live(world.get(), 30).empty();
}

TEST(ExactStatics, EveryKindOfJointPassesTheLoadToGlue) {
  for (const char* joint :
       {"kind = \"hinge\"\nanchor = [0, -0.5]", "kind = \"distance\"", "kind = \"rope\"",
        "kind = \"prismatic\"\naxis = [1, 0]\nanchor = [0, -0.5]",
        "kind = \"prismatic\"\naxis = [0, 1]\nanchor = [0, -0.5]\nlimits = [0, 1]",
        "kind = \"wheel\"\nanchor = [0, -2]\naxis = [0, 1]",
        "kind = \"wheel\"\nanchor = [0, -2]\naxis = [1, 0]\nlimits = [-1, 1]",
        "kind = \"weld\"\nanchor = [0, -0.5]\nfrequency = 30"}) {
    EXPECT_FALSE(TearsOff(1.02 * 14, joint)) << joint;
    EXPECT_TRUE(TearsOff(0.98 * 14, joint)) << joint;
  }
}

/// A disc of 1 kg m2 on a hinge with this motor.
std::unique_ptr<World> Turned(const std::string& motor, const std::string& rest = "") {
  const double radius = std::pow(2 / kPi, 0.25);  // pi r^4 / 2 = 1
  return ExactWorld(PostText(0, 0) + PartText("wheel", "circle = " + FloatDigits(radius)) +
                    HingeText("axle", "post", "wheel", 0, 0, "motor = " + motor + "\n" + rest));
}

TEST(ExactStatics, AMotorAtItsBoundGivesExactlyThatTorque) {
  for (const double torque : {0.25, 4.0, 100.0}) {
    const auto world = Turned("{speed = 1000, torque = " + FloatDigits(torque) + "}");
    Steps(world.get(), 30);
    EXPECT_NEAR(world->Read(0).spin / (torque * 0.5), 1, 1e-4) << torque;
    // Turned back, it brakes with as much.
    Steps(world.get(), 30);
    EXPECT_NEAR(world->Read(0).spin / torque, 1, 1e-4) << torque;
  }
}

TEST(ExactStatics, AMotorStrongerThanItsLoadTurnsAtItsSpeedAndAWeakerOneSinks) {
  const auto arm = [](double torque) {
    return ExactWorld(PostText(0, 0) + PartText("arm", "box = [2, 0.1]\nposition = [1, 0]") +
                      HingeText("axle", "post", "arm", 0, 0,
                                "motor = {speed = 0, torque = " + FloatDigits(torque) + "}"));
  };
  // 0.2 kg at 1 m: 2 N m.
  const auto holds = arm(2.002);
  Steps(holds.get(), 300);
  EXPECT_NEAR(holds->Read(0).angle, 0, 1e-4);
  const auto sinks = arm(1.998);
  Steps(sinks.get(), 300);
  EXPECT_LT(sinks->Read(0).angle, -1e-3);
}

TEST(ExactStatics, ALimitHoldsAnArmAndItsLoad) {
  const auto world =
      ExactWorld(PostText(0, 0) + PartText("arm", "box = [2, 0.1]\nposition = [1, 0]") +
                 PartText("load", "box = [1, 1]\nposition = [2, -1]\ndensity = 100") +
                 HingeText("axle", "post", "arm", 0, 0, "limits = [-0.5, 1]") +
                 HingeText("eye", "arm", "load", 2, -0.5 + 0.5));
  Steps(world.get(), 600);
  const BodyState arm = world->Read(0);
  EXPECT_NEAR(arm.angle, -0.5, 1e-3) << "500 times its own mass hangs on it";
  EXPECT_LT(Drift(*world), 1e-5);
}

TEST(ExactStatics, APrismaticLimitHoldsToTheMicrometre) {
  const auto world = ExactWorld(
      PostText(0, 0) + PartText("load", "box = [1, 1]\nposition = [0, -2]\ndensity = 50") +
      "[[joint]]\nname = \"j\"\nkind = \"prismatic\"\na = \"post\"\nb = \"load\"\naxis = [0, 1]\n"
      "limits = [-1, 1]\n");
  Steps(world.get(), 300);
  EXPECT_NEAR(world->Read(0).position.y(), -3, 1e-5);
  EXPECT_NEAR(world->Read(0).velocity.y(), 0, 1e-5);
}

TEST(ExactStatics, ASpringCarriesItsLoadByHookesLaw) {
  // m g / k below its length; k = m (2 pi f)^2.
  const auto world = ExactWorld(
      PostText(0, 0) + PartText("load", "box = [1, 1]\nposition = [0, -3]\ndensity = 4") +
      "[[joint]]\nname = \"j\"\nkind = \"distance\"\na = \"post\"\nb = \"load\"\n"
      "frequency = 1\ndamping_ratio = 0.7\n");
  Steps(world.get(), 900);
  EXPECT_NEAR(world->Read(0).position.y(), -3 - 10 / (4 * kPi * kPi), 1e-3);
}

TEST(ExactStatics, ARopeOverAPulleyBalancesByItsRatio) {
  // 1 kg on a block of two strands holds 0.5 kg; both stay.
  const auto world = ExactWorld(
      PartText("light", "box = [1, 1]\nposition = [-2, 0]\ndensity = 0.5") +
      PartText("heavy", "box = [1, 1]\nposition = [2, 0]") +
      "[[joint]]\nname = \"p\"\nkind = \"pulley\"\na = \"light\"\nb = \"heavy\"\nratio = 2\n"
      "anchor_a = [-2, 0]\nanchor_b = [2, 0]\nground_a = [-2, 5]\nground_b = [2, 5]\n");
  Steps(world.get(), 300);
  EXPECT_NEAR(world->Read(0).position.y(), 0, 1e-4);
  EXPECT_NEAR(world->Read(1).position.y(), 0, 1e-4);
}

}  // namespace exact_statics_test
}  // namespace seam
