/// Each kind of joint against its equation.

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/geometry.h"
#include "common/measure/energy.h"
#include "common/measure/joint_drift.h"
#include "tests/support/small_world.h"

namespace seam {
namespace joints_test {

const char* kPost = "[[part]]\nname = \"post\"\nbox = [0.2, 0.2]\nanchored = true\n";
const char* kDriver = "[[player]]\nname = \"ann\"\n";
const char* kWeightless = "gravity = [0, 0]\n";

std::string PartOf(const std::string& name, const std::string& rest) {
  return "[[part]]\nname = \"" + name + "\"\n" + rest + "\n";
}

/// Between "post" and "load".
std::string JointOf(const std::string& kind, const std::string& rest = "") {
  return "[[joint]]\nname = \"j\"\nkind = \"" + kind + "\"\na = \"post\"\nb = \"load\"\n" + rest +
         "\n";
}

Input DriveOf(int drive, int lift = 0) {
  return {static_cast<std::int8_t>(drive), static_cast<std::int8_t>(lift), 0};
}

TEST(Joints, ATorqueLimitedHingeMotorGainsTOverI) {
  // A disc of 2 kg/m^2 and 1 m: m = 2 pi, I = m r^2/2 = pi.
  const auto world = SmallWorld(std::string(kPost) + PartOf("load", "circle = 1\ndensity = 2") +
                                JointOf("hinge", "motor = {speed = 1000, torque = 4}"));
  Steps(world.get(), 60);
  EXPECT_NEAR(double{world->Read(0).spin}, 4 / kPi, 2e-3);
  Steps(world.get(), 60);
  EXPECT_NEAR(double{world->Read(0).spin}, 8 / kPi, 4e-3);
  EXPECT_NEAR(double{world->Read(0).position.norm()}, 0, 1e-4);
}

TEST(Joints, AHingeMotorHoldsItsSpeedAndStopsAtTheLimit) {
  const auto world =
      SmallWorld(std::string(kPost) + PartOf("load", "circle = 1") +
                     JointOf("hinge", "motor = {speed = 2, torque = 50}\nlimits = [-0.5, 3]"),
                 "", kWeightless);
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).spin, 2, 1e-3);
  // At alpha = T/I until w is reached: w t - w^2 / (2 alpha), and w h / 2 for discrete substeps.
  EXPECT_NEAR(world->Read(0).angle, 2 - 4 / (2 * 50 / (kPi / 2)) + 2.0 / 240, 2e-3);
  Steps(world.get(), 120);
  EXPECT_NEAR(world->Read(0).angle, 3, 0.02);
  EXPECT_NEAR(world->Read(0).spin, 0, 1e-2);
}

TEST(Joints, RevoluteAndHingeAreOneJoint) {
  const std::string parts =
      std::string(kPost) + PartOf("load", "box = [2, 0.3]\nposition = [1, 0]");
  const auto one = SmallWorld(parts + JointOf("hinge", "anchor = [0, 0]"));
  const auto other = SmallWorld(parts + JointOf("revolute", "anchor = [0, 0]"));
  Steps(one.get(), 90);
  Steps(other.get(), 90);
  EXPECT_EQ(one->Hash(), other->Hash());
}

/// A load of 1 kg on a vertical rail, with this motor.
std::unique_ptr<World> Lift(const std::string& rest) {
  return SmallWorld(std::string(kDriver) + kPost +
                    PartOf("load", "box = [1, 1]\nposition = [0, 5]") +
                    JointOf("prismatic", "axis = [0, 1]\n" + rest));
}

TEST(Joints, APrismaticMotorTooWeakForItsLoadOnlySlowsItsFall) {
  const auto world = Lift("motor = {speed = 0, force = 6}");
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).velocity.y(), -(10 - 6), 0.01);  // a = g - F/m
  EXPECT_NEAR(world->Read(0).velocity.x(), 0, 1e-4);
}

TEST(Joints, AStrongPrismaticMotorLiftsAtItsSpeedUpToTheLimit) {
  const auto world = Lift(
      "limits = [-3, 2]\n"
      "motor = {player = \"ann\", axis = \"lift\", speed = 1.5, force = 25}");
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).position.y(), 5, 1e-3) << "it brakes while nobody drives";
  world->SetInput(0, DriveOf(127));
  Steps(world.get(), 30);
  EXPECT_NEAR(world->Read(0).position.y(), 5, 1e-3) << "drive is not its axis";
  world->SetInput(0, DriveOf(0, 127));
  Steps(world.get(), 3);
  EXPECT_NEAR(world->Read(0).velocity.y(), (25 - 10) * 3 / 60.0, 0.01);  // a = F/m - g
  Steps(world.get(), 40);
  EXPECT_NEAR(world->Read(0).velocity.y(), 1.5, 1e-3);
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).position.y(), 7, 0.01);
  world->SetInput(0, DriveOf(0, -127));
  Steps(world.get(), 300);
  EXPECT_NEAR(world->Read(0).position.y(), 2, 0.01);
}

TEST(Joints, APrismaticLoadDoesNotTurn) {
  const auto world =
      SmallWorld(std::string(kPost) + PartOf("load", "box = [4, 0.2]\nposition = [1.8, 0]") +
                 JointOf("prismatic", "anchor = [0, 0]\naxis = [1, 0]"));
  Steps(world.get(), 240);
  EXPECT_NEAR(world->Read(0).angle, 0, 5e-3);
  EXPECT_NEAR(world->Read(0).position.y(), 0, 5e-3);
}

TEST(Joints, ARopeDoesNothingUntilItIsTaut) {
  const auto world =
      SmallWorld(std::string(kPost) + PartOf("load", "circle = 0.2\nposition = [0, -1]") +
                 JointOf("rope", "length = 4"));
  for (int t = 1; t <= 44; ++t) {
    world->Step();
    const double fallen = 10.0 / 2 * t * t / 3600;  // the parabola: it is a mechanism
    if (fallen >= 3) break;
    ASSERT_NEAR(world->Read(0).position.y(), -1 - fallen, 2e-3) << t;
  }
  Steps(world.get(), 120);
  EXPECT_NEAR(world->Read(0).position.y(), -4, 0.01);
  EXPECT_NEAR(world->Read(0).velocity.norm(), 0, 0.02);
}

TEST(Joints, ARopesDefaultLengthIsTheInitialDistance) {
  const auto world = SmallWorld(
      std::string(kPost) + PartOf("load", "circle = 0.2\nposition = [3, 0]") + JointOf("rope"));
  float longest = 0;
  for (int t = 0; t < 240; ++t) {
    world->Step();
    longest = std::max(longest, world->Read(0).position.norm());
  }
  EXPECT_NEAR(longest, 3, 0.02);
}

/// Seconds between passes through the middle, downwards, of a load let go `off` m above it.
double PeriodOf(World* world, double middle) {
  double last = -1, first = -1;
  int passes = 0;
  double before = double{world->Read(0).position.y()} - middle;
  for (int t = 1; t <= 960; ++t) {
    world->Step();
    const double now = double{world->Read(0).position.y()} - middle;
    if (before > 0 && now <= 0) {
      last = (t - now / (now - before)) / 240.0;
      if (first < 0) first = last;
      ++passes;
    }
    before = now;
  }
  return (last - first) / (passes - 1);
}

TEST(Joints, ASpringsPeriodIsTwoPiRootMOverK) {
  // k = m (2 pi f)^2, so that the period is 1/f: 0.5 s. Gravity moves the middle by g/(2 pi f)^2.
  const auto world = SmallWorld(
      std::string(kPost) + PartOf("load", "box = [1, 1]\nposition = [0, -3]\ndensity = 3") +
          JointOf("distance", "length = 3\nfrequency = 2\ndamping_ratio = 0"),
      "substeps = 4\ntick_hz = 240");
  const double omega = 2 * kPi * 2;
  EXPECT_NEAR(PeriodOf(world.get(), -3 - 10 / (omega * omega)), 0.5, 0.005);
}

TEST(Joints, ADampedSpringLosesItsSwingByItsRatio) {
  // x ~ exp(-zeta omega t): after the period 2 pi/(omega sqrt(1 - zeta^2)) exp(-2 pi zeta/sqrt()).
  const double zeta = 0.1, omega = 2 * kPi;
  const auto world =
      SmallWorld(std::string(kPost) + PartOf("load", "box = [1, 1]\nposition = [0, -3.5]") +
                     JointOf("distance", "length = 3\nfrequency = 1\ndamping_ratio = 0.1"),
                 "substeps = 8\ntick_hz = 240", kWeightless);
  const double damped = std::sqrt(1 - zeta * zeta);
  Steps(world.get(), static_cast<int>(std::lround(240 * 2 * kPi / (omega * damped))));
  const double left = -3 - double{world->Read(0).position.y()};
  EXPECT_NEAR(left / 0.5, std::exp(-2 * kPi * zeta / damped), 0.01);
}

TEST(Joints, ADistanceWithinLimitsIsSlackBetweenThem) {
  const auto world = SmallWorld(
      std::string(kPost) + PartOf("load", "circle = 0.2\nposition = [2, 0]\nvelocity = [1, 0]") +
          JointOf("distance", "limits = [1, 3]"),
      "", kWeightless);
  Steps(world.get(), 54);
  EXPECT_NEAR(world->Read(0).velocity.x(), 1, 1e-5) << "free";
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).position.x(), 3, 0.01) << "stopped without a rebound";
}

TEST(Joints, AWheelWithLimitsAndNoSpringSlidesBetweenThem) {
  const auto world =
      SmallWorld(std::string(kPost) + PartOf("load", "circle = 0.3\nposition = [0, 4]") +
                 JointOf("wheel", "limits = [-0.5, 0.5]"));
  Steps(world.get(), 12);
  EXPECT_NEAR(world->Read(0).velocity.y(), -2, 0.01) << "it falls freely";
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).position.y(), 3.5, 0.01);
}

TEST(Joints, ASoftWeldSwingsAtItsFrequency) {
  // About its anchor at the centre of mass: a torsion spring on I, at f whatever I is.
  const auto world = SmallWorld(std::string(kPost) + PartOf("load", "box = [2, 0.5]\nspin = 1") +
                                    JointOf("weld", "frequency = 2\ndamping_ratio = 0"),
                                "substeps = 8\ntick_hz = 240", kWeightless);
  ASSERT_EQ(world->body_count(), 1) << "a soft weld is a joint, never one body";
  // theta = w0/omega sin(omega t): its first peak is at a quarter of the period.
  Steps(world.get(), 30);
  EXPECT_NEAR(world->Read(0).angle, 1 / (4 * kPi), 2e-3);
  EXPECT_NEAR(world->Read(0).spin, 0, 0.05);
  Steps(world.get(), 60);
  EXPECT_NEAR(world->Read(0).angle, -1 / (4 * kPi), 3e-3);
}

TEST(Joints, ASoftWeldsEnergyDecaysAsThatOfAnImplicitSpring) {
  // The engine's springs are stepped implicitly: of the energy 1 / (1 + (w h)^2) is left each step.

  const std::string text = "gravity = [0, 0]\n[solver]\nsleep = false\nsubsteps = 8\n" +
                           std::string("joints = \"iterative\"\n") + std::string(kPost) +
                           PartOf("load", "box = [2, 0.5]\nspin = 1") +
                           JointOf("weld", "frequency = 1\ndamping_ratio = 0");
  World world(ParseScene(text, "weld.toml"));
  const EnergyMeter meter(world.scene(), world.composition());
  const double begin = meter.Of({world.Read(0)});
  for (int t = 0; t < 60; ++t) {
    world.Step();
    const double omega = 2 * kPi, h = 1.0 / 480;
    const double left = begin * std::exp(-omega * omega * h * (t + 1) / 60);
    ASSERT_NEAR(meter.Of({world.Read(0)}), left, 0.015 * begin) << t;
  }
}

TEST(Joints, GlueMakesOneBodyAsAWeldDoes) {
  const std::string parts = PartOf("post", "box = [1, 1]") +
                            PartOf("load", "box = [1, 1]\nposition = [1, 0]\nangle = 0.1");
  const auto glued = SmallWorld(parts + JointOf("glue", "strength = 200"));
  const auto welded = SmallWorld(parts + JointOf("weld"));
  ASSERT_EQ(glued->body_count(), 1);
  EXPECT_EQ(glued->composition().hash, welded->composition().hash);
  EXPECT_EQ(glued->scene().joints[0].strength, 200);
}

TEST(Joints, AMotorJointHoldsUpToItsForce) {
  const std::string parts = std::string(kPost) + PartOf("load", "box = [1, 1]\nposition = [2, 0]");
  const auto weak = SmallWorld(parts + JointOf("motor", "force = 7\ntorque = 1"));
  Steps(weak.get(), 60);
  EXPECT_NEAR(weak->Read(0).velocity.y(), -3, 0.02);  // a = g - F/m
  const auto strong = SmallWorld(parts + JointOf("motor", "force = 12\ntorque = 1"));
  Steps(strong.get(), 240);
  EXPECT_NEAR(strong->Read(0).position.y(), 0, 1e-3);
  EXPECT_NEAR(strong->Read(0).angle, 0, 1e-4);
}

TEST(Joints, AMotorJointFollowsItsPlayersAxis) {
  const auto world = SmallWorld(
      std::string(kDriver) + kPost + PartOf("load", "box = [1, 1]\nposition = [2, 0]") +
          JointOf("motor",
                  "force = 40\ntorque = 20\nfollow = {player = \"ann\", axis = \"lift\", "
                  "reach = [0, 3], swing = -1}"),
      "", kWeightless);
  world->SetInput(0, DriveOf(0, 127));
  Steps(world.get(), 4);
  EXPECT_NEAR(world->Read(0).velocity.y(), 40.0 * 4 / 60, 0.05);    // F t/m
  EXPECT_NEAR(world->Read(0).spin, -20 / (1 / 6.0) * 4 / 60, 0.5);  // T t/I
  Steps(world.get(), 240);
  EXPECT_NEAR(world->Read(0).position.y(), 3, 0.01);
  EXPECT_NEAR(world->Read(0).angle, -1, 0.01);
  world->SetInput(0, DriveOf(0, 0));
  Steps(world.get(), 240);
  EXPECT_NEAR(world->Read(0).position.y(), 0, 0.01);
}

/// Runs for `ticks` with a barrier every three, goes back to the eighth and replays. Returns the
/// number of ticks that differ.
int TicksThatDiffer(const std::string& joint) {
  const std::string text =
      std::string(kDriver) + "[[part]]\nname = \"ground\"\nchain = [[-20, -6], [20, -6]]\n" +
      PartOf("frame", "box = [4, 0.3]\nposition = [0, 0]\ndensity = 4") +
      "[[joint]]\nname = \"hang\"\nkind = \"rope\"\na = \"ground\"\nb = \"frame\"\n"
      "anchor_a = [0, 4]\nanchor_b = [-1, 0]\n" +
      PartOf("post", "box = [0.5, 0.5]\nposition = [-1, -0.5]") +
      "[[joint]]\nname = \"weld\"\nkind = \"weld\"\na = \"frame\"\nb = \"post\"\n" +
      PartOf("load", "box = [0.6, 0.4]\nposition = [1, -1.5]\nspin = 3\nvelocity = [1, 0]") + joint;
  World world(ParseScene(text, "s.toml"));
  const auto step = [&world] {
    const auto t = static_cast<int>(world.tick());
    world.SetInput(0, DriveOf(t % 40 < 20 ? 127 : -90, t % 30 < 15 ? -127 : 100));
    world.Step();
  };
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  while (world.tick() < 150) {
    step();
    if (world.tick() % 3 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  EXPECT_TRUE(world.Restore(barriers[7]).ok());
  int different = 0;
  while (world.tick() < 150) {
    step();
    if (world.tick() % 3 == 0) world.Barrier();
    if (world.Hash() != hashes[static_cast<std::size_t>(world.tick() - 1)]) ++different;
  }
  return different;
}

TEST(Joints, EveryKindReplaysBitForBitFromABarrier) {
  const std::string motor = "motor = {player = \"ann\", axis = \"lift\", speed = 6, ";
  const std::pair<const char*, std::string> kinds[] = {
      {"hinge", motor + "torque = 3}\nlimits = [-0.4, 0.7]"},
      {"prismatic", motor + "force = 9}\naxis = [1, 2]\nlimits = [-0.5, 0.4]"},
      {"wheel", motor + "torque = 3}\nfrequency = 3\nlimits = [-0.3, 0.3]"},
      {"distance", "frequency = 2\nlimits = [1.5, 2.5]"},
      {"distance", ""},
      {"rope", "length = 2.6"},
      {"weld", "frequency = 2"},
      {"motor",
       "force = 30\ntorque = 4\nfollow = {player = \"ann\", reach = [1, 0.5], swing = 1}"}};
  for (const auto& [kind, rest] : kinds) {
    EXPECT_EQ(TicksThatDiffer(JointOf(kind, rest)), 0) << kind;
  }
}

TEST(JointDrift, KnowsAxesLimitsAndRopes) {
  const auto drift = [](const std::string& kind, const std::string& rest, const Vec2& to) {
    const Scene scene =
        ParseScene(std::string(kPost) + PartOf("load", "box = [1, 1]\nposition = [2, 0]") +
                       JointOf(kind, rest),
                   "s.toml");
    return JointMeter(scene, Compose(scene)).Worst({{to, 0, {0, 0}, 0}});
  };
  EXPECT_NEAR(drift("prismatic", "", {7, 0.25f}), 0.25, 1e-6);
  EXPECT_NEAR(drift("prismatic", "limits = [0, 1]", {3.3f, -0.4f}), 0.5, 1e-6);
  EXPECT_NEAR(drift("wheel", "limits = [-1, 1]", {2.3f, 1.4f}), 0.5, 1e-6);
  EXPECT_NEAR(drift("wheel", "frequency = 3", {2.3f, 1.4f}), 0.3, 1e-6);
  EXPECT_EQ(drift("rope", "", {1, 1}), 0);
  EXPECT_NEAR(drift("rope", "", {3, 4}), 3, 1e-6);
  EXPECT_NEAR(drift("distance", "limits = [1, 4]", {3, 4}), 1, 1e-6);
  EXPECT_NEAR(drift("distance", "limits = [1, 4]\nfrequency = 2", {0.5f, 0}), 0.5, 1e-6);
  EXPECT_NEAR(drift("weld", "frequency = 2", {2.3f, 0.4f}), 0.5, 1e-6);
  EXPECT_EQ(drift("motor", "force = 1\ntorque = 1", {5, 5}), 0);
}

}  // namespace joints_test
}  // namespace seam
