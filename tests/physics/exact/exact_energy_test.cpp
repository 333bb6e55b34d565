/// Exact joints conserve energy and momentum and stay closed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/geometry.h"
#include "common/measure/energy.h"
#include "tests/physics/exact/exact_scenes.h"

namespace seam {
namespace exact_energy_test {

double EnergyOf(const World& world) {
  return MechanicalEnergy(world.scene(), world.composition(), StatesOf(world));
}

/// A bob on a hinged rod of 2 m, released at the height of the hinge.
std::string Pendulum() {
  return PostText(0, 0) + PartText("bob", "box = [2, 0.1]\nposition = [1, 0]") +
         HingeText("pivot", "post", "bob", 0, 0);
}

TEST(ExactEnergy, APendulumKeepsItsEnergyForAMinute) {
  const auto world = ExactWorld(Pendulum());
  // From hanging at rest up to where it began: 0.2 kg by 1 m.
  const double range = 0.2 * 10 * 1;
  const double begin = EnergyOf(*world);
  Steps(world.get(), 3600);
  EXPECT_GE(1 + (EnergyOf(*world) - begin) / range, 0.995);
  EXPECT_LE(1 + (EnergyOf(*world) - begin) / range, 1.005);
  EXPECT_LT(Drift(*world), 1e-5);
}

/// Falls on a floor and comes up again, for a minute: continuous collision lifts it at each impact.
TEST(ExactEnergy, AnElasticMechanismThatBouncesGainsNone) {
  for (const char* solver : {"", "contacts = \"soft\"\n"}) {
    std::string parts = PartText("floor", "box = [60, 1]\nposition = [0, -0.5]\nanchored = true");
    for (const char* at : {"-0.6", "0.6"}) {
      parts += PartText(*at == '-' ? "a" : "b",
                        "circle = 0.3\nrestitution = 1\nfriction = 0\nposition = [" +
                            std::string(at) + ", 3]\nvelocity = [0, " + at + "]");
    }
    parts += "[[joint]]\nname = \"rod\"\na = \"a\"\nb = \"b\"\nkind = \"distance\"\n";
    const auto world = ExactWorld(parts, solver);
    const double begin = EnergyOf(*world);
    for (int second = 0; second < 60; ++second) {
      Steps(world.get(), 60);
      ASSERT_LT(EnergyOf(*world), 1.05 * begin) << solver << ' ' << second;
    }
    EXPECT_GT(EnergyOf(*world), 0.8 * begin) << solver;
  }
}

/// 20 Hz and one substep, fewer than the loader allows.
std::unique_ptr<World> CoarseWorld(const std::string& parts, const std::string& top = "") {
  Scene scene = ParseScene(top + "\n[solver]\nsleep = false\n" + kExactJoints +
                               "tick_hz = 20\njoint_substeps = 1\n" + parts,
                           "coarse.toml");
  scene.solver.substeps = 1;
  return std::make_unique<World>(scene);
}

TEST(ExactEnergy, ASubstepMayTurnABodyFarWithoutLoss) {
  // The pendulum turns by up to 0.27 rad in a substep.
  const auto swing =
      CoarseWorld(PostText(0, 0) + PartText("bob", "box = [1, 0.1]\nposition = [0.5, 0]") +
                  HingeText("pivot", "post", "bob", 0, 0));
  const double range = 0.1 * 10 * 0.5;
  for (int t = 0; t < 1200; ++t) {
    swing->Step();
    EXPECT_NEAR(EnergyOf(*swing), 0, 0.03 * range) << t;
  }
  // A sun, an arm and a planet that rolls in a fixed ring of 2 m and on the sun: by 0.4 rad.
  const auto gears = CoarseWorld(
      PartText("post", "box = [0.2, 0.2]\nanchored = true\ngroup = -1") +
          PartText("sun", "circle = 1\nspin = 9\ngroup = -1") +
          PartText("arm", "box = [1.5, 0.1]\nposition = [0.75, 0]\ngroup = -1") +
          PartText("planet", "circle = 0.5\nposition = [1.5, 0]\ngroup = -1") +
          HingeText("a", "post", "arm", 0, 0) + HingeText("s", "arm", "sun", 0, 0) +
          HingeText("p", "arm", "planet", 1.5, 0) +
          "[[joint]]\nname = \"outer\"\nkind = \"gear\"\njoints = [\"a\", \"p\"]\nratio = 0.25\n"
          "[[joint]]\nname = \"inner\"\nkind = \"gear\"\njoints = [\"s\", \"p\"]\nratio = 0.5\n",
      "gravity = [0, 0]\n");
  gears->Step();
  const double begin = EnergyOf(*gears);
  Steps(gears.get(), 600);
  EXPECT_NEAR(EnergyOf(*gears) / begin, 1, 1e-3);
  EXPECT_LT(Drift(*gears), 1e-5);
}

TEST(ExactEnergy, ADoublePendulumSwingsTheSameToBothSides) {
  // A scene and its mirror image: the same equations.
  const auto swing = [](double side) {
    return ExactWorld(
        PostText(0, 0) +
        PartText("upper", "box = [1, 0.1]\nposition = [" + FloatDigits(0.5 * side) + ", 0]") +
        PartText("lower", "box = [1, 0.1]\nposition = [" + FloatDigits(1.5 * side) + ", 0]") +
        HingeText("top", "post", "upper", 0, 0) + HingeText("elbow", "upper", "lower", side, 0));
  };
  const auto left = swing(-1), right = swing(1);
  Steps(left.get(), 60);
  Steps(right.get(), 60);
  for (int body = 0; body < 2; ++body) {
    const BodyState l = left->Read(body), r = right->Read(body);
    EXPECT_NEAR(l.position.x(), -r.position.x(), 1e-4);
    EXPECT_NEAR(l.position.y(), r.position.y(), 1e-4);
    EXPECT_NEAR(l.angle, -r.angle, 1e-4);
  }
}

struct Kept {
  double energy = 0, spin = 0, px = 0, py = 0;
};

Kept KeptOf(const World& world) {
  Kept sum;
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState s = world.Read(body);
    const MassPoint m = world.mass_point(body);
    const double mass = double{m.mass}, inertia = double{m.inertia};
    const double vx = double{s.velocity.x()}, vy = double{s.velocity.y()}, w = double{s.spin};
    const double x = double{s.position.x()}, y = double{s.position.y()};
    sum.energy += (mass * (vx * vx + vy * vy) + inertia * w * w) / 2;
    sum.spin += mass * (x * vy - y * vx) + inertia * w;
    sum.px += mass * vx;
    sum.py += mass * vy;
  }
  return sum;
}

/// Five links in a row that turn about their middle at `spin` rad/s as one.
std::unique_ptr<World> SpinningChain(double spin) {
  auto world = ExactWorld(ChainText(5, -2.5, 0), "", "gravity = [0, 0]\n");
  for (int body = 0; body < 5; ++body) {
    BodyState state = world->Read(body);
    state.spin = static_cast<float>(spin);
    state.velocity = {0, static_cast<float>(spin) * state.position.x()};
    world->Write(body, state);
  }
  return world;
}

TEST(ExactEnergy, AFreeSpinningChainKeepsEnergyAndMomentaInWeightlessness) {
  for (const double spin : {0.5, 3.0}) {
    const auto world = SpinningChain(spin);
    const Kept begin = KeptOf(*world);
    ASSERT_GT(begin.spin, 1);
    for (int second = 1; second <= 10; ++second) {
      Steps(world.get(), 60);
      const Kept now = KeptOf(*world);
      EXPECT_NEAR(now.energy / begin.energy, 1, 1e-4) << spin << " rad/s, second " << second;
      EXPECT_NEAR(now.spin / begin.spin, 1, 1e-4) << spin << " rad/s, second " << second;
      EXPECT_NEAR(now.px, 0, 1e-4);
      EXPECT_NEAR(now.py, 0, 1e-4);
    }
    EXPECT_LT(Drift(*world), 1e-5);
  }
}

TEST(ExactEnergy, AFoldingChainKeepsMomentaAndEnergy) {
  auto world = SpinningChain(3);
  BodyState end = world->Read(4);
  end.spin = -3;  // it folds at once
  world->Write(4, end);
  world->Step();  // what is not in agreement with the joints is gone by now
  const Kept begin = KeptOf(*world);
  for (int second = 1; second <= 10; ++second) {
    Steps(world.get(), 60);
    const Kept now = KeptOf(*world);
    EXPECT_NEAR(now.energy / begin.energy, 1, 1e-5) << second;
    EXPECT_NEAR(now.spin / begin.spin, 1, 1e-5) << second;
  }
  EXPECT_LT(Drift(*world), 1e-5);
}

/// Six chains of two to four rods of three densities at `speed` m/s, each its own way, in a closed
/// room. Folded flat, the ends of a chain strike each other along themselves, where it can hardly
/// give way.
std::string RodBox(int start, double speed) {
  const std::string bouncy = "friction = 0\nrestitution = 1\n";
  std::string parts;
  for (const char* wall :
       {"box = [64, 8]\nposition = [0, -20]", "box = [64, 8]\nposition = [0, 20]",
        "box = [8, 32]\nposition = [-20, 0]", "box = [8, 32]\nposition = [20, 0]"}) {
    parts += PartText("wall" + std::to_string(parts.size()),
                      std::string(wall) + "\nanchored = true\n" + bouncy);
  }
  for (int chain = 0; chain < 6; ++chain) {
    const double x = chain % 2 == 0 ? -15.5 : 1, y = -10 + 10 * (chain / 2);
    const double turn = 1 + 2.4 * chain + 0.7 * start;
    const int rods = 2 + (chain + start) % 3, length = rods == 4 ? 3 : 4;
    for (int i = 0; i < rods; ++i) {
      const std::string name = "rod" + std::to_string(chain) + std::to_string(i);
      parts += PartText(
          name,
          "box = [" + std::to_string(length) + ", 0.8]\nposition = [" +
              FloatDigits(x + length * (i + 0.5)) + ", " + FloatDigits(y) + "]\nvelocity = [" +
              FloatDigits(speed * std::cos(turn)) + ", " + FloatDigits(speed * std::sin(turn)) +
              "]\ndensity = " + FloatDigits(0.5 * (1 << (chain + i + start) % 3)) + "\n" + bouncy);
      if (i == 0) continue;
      parts += HingeText("pin" + name, "rod" + std::to_string(chain) + std::to_string(i - 1), name,
                         x + length * i, y);
    }
  }
  return parts;
}

TEST(ExactEnergy, JointedRodsThatStrikeEachOtherKeepTheirEnergy) {
  for (const auto& [speed, substeps] : {std::pair(2.4, 1), std::pair(2.4, 4), std::pair(2.4, 8),
                                        std::pair(8.0, 1), std::pair(8.0, 2), std::pair(16.0, 1)}) {
    for (int start = 0; start < 4; ++start) {
      const auto world =
          ExactWorld(RodBox(start, speed),
                     "joint_substeps = " + std::to_string(substeps) + "\ncontinuous = false\n",
                     "gravity = [0, 0]\nsize_max = 100\n");
      const double begin = EnergyOf(*world);
      for (int t = 0; t < 2400; ++t) world->Step();
      EXPECT_NEAR(EnergyOf(*world) / begin, 1, 0.01)
          << speed << " m/s, substeps " << substeps << ", start " << start;
    }
  }
}

TEST(ExactEnergy, AThrownChainKeepsEnergyAndMomentumAboutItsCentre) {
  // It falls for two seconds, turning by up to 0.3 rad in a substep; nothing touches it.
  auto world = ExactWorld(ChainText(3, -1.5, 0, "group = -1\n"), "joint_substeps = 1\n");
  const double spins[] = {18, -12, 9};
  for (int body = 0; body < 3; ++body) {
    BodyState state = world->Read(body);
    state.spin = static_cast<float>(spins[body]);
    state.velocity = {2, 8};
    world->Write(body, state);
  }
  world->Step();  // what is not in agreement with the joints is gone by now
  const double begin = EnergyOf(*world);
  const Kept was = KeptOf(*world);
  const double mass = 0.6, inner = was.energy - (was.px * was.px + was.py * was.py) / (2 * mass);
  for (int t = 0; t < 120; ++t) {
    world->Step();
    EXPECT_NEAR(EnergyOf(*world), begin, 1e-4 * inner) << t;
    EXPECT_NEAR(KeptOf(*world).px, was.px, 1e-5);
  }
  EXPECT_LT(Drift(*world), 1e-5);
}

TEST(ExactEnergy, AFullTurnOfAFlywheelIsAFullTurn) {
  // 10 rad/s about a hinge in its centre of mass, for 10 s.
  const auto world = ExactWorld(PostText(0, 0) + PartText("wheel", "circle = 1\nspin = 10") +
                                HingeText("axle", "post", "wheel", 0, 0));
  Steps(world.get(), 600);
  EXPECT_NEAR(world->Read(0).angle, 100, 1e-3);
  EXPECT_NEAR(world->Read(0).spin, 10, 1e-4);
}

/// A drum that a motor drives down takes up a rope with a fifth of the speed of the load, until the
/// load is where the rope comes from and there is no more of it.
std::string RunToItsEnd(const std::string& more) {
  return PostText(0, 0) + PartText("drum", "box = [0.5, 0.5]\nposition = [2, 0]\ndensity = 4") +
         PartText("load", "box = [0.5, 0.5]\nposition = [-2, 0]") +
         "[[joint]]\nname = \"slide\"\nkind = \"prismatic\"\na = \"post\"\nb = \"drum\"\n"
         "anchor = [2, 0]\naxis = [0, 1]\nmotor = {speed = -5, force = 5000}\n"
         "[[joint]]\nname = \"rope\"\nkind = \"pulley\"\na = \"drum\"\nb = \"load\"\n"
         "ground_a = [2, 1]\nground_b = [-2.3, 0.5]\nratio = 0.2\n" +
         more;
}

TEST(ExactEnergy, AMechanismAtItsDeadEndStops) {
  const std::string linked =
      PartText("third", "box = [0.5, 0.5]\nposition = [-3, -1]\ndensity = 0.5") +
      "[[joint]]\nname = \"rod\"\nkind = \"distance\"\na = \"load\"\nb = \"third\"\n";
  for (const std::string& more : {std::string(), linked}) {
    for (const char* substeps : {"", "joint_substeps = 1\n", "joint_substeps = 4\n"}) {
      const auto world = ExactWorld(RunToItsEnd(more), substeps);
      for (int t = 0; t < 240; ++t) {
        world->Step();
        for (const BodyState& state : StatesOf(*world)) {
          // The motor's 5 m/s by the ratio are 25 of the load, and its appendages may swing.
          ASSERT_LT(state.velocity.norm(), 60) << more << substeps << t;
        }
      }
      EXPECT_LT(Drift(*world), 1e-3) << more << substeps;
    }
  }
}

TEST(ExactEnergy, ALoadStopsAtItsPulley) {
  // 3 kg pull 1 kg up, or with a ratio of 3 fall slower than it rises; the right one may swing.
  for (const double ratio : {0.4, 1.0, 3.0}) {
    for (const char* swing : {"", "velocity = [1.5, 0]\n"}) {
      for (const char* substeps : {"", "joint_substeps = 1\n", "joint_substeps = 4\n"}) {
        const auto world = ExactWorld(
            PartText("left", "box = [1, 1]\ndensity = " + FloatDigits(ratio < 1 ? 9 : 3) +
                                 "\nposition = [-3, 0]\ngroup = -1") +
                PartText("right",
                         std::string("box = [1, 1]\nposition = [3, 0]\ngroup = -1\n") + swing) +
                "[[joint]]\nname = \"rope\"\nkind = \"pulley\"\na = \"left\"\nb = \"right\"\n"
                "ground_a = [-3, 10]\nground_b = [3, 2]\nratio = " +
                FloatDigits(ratio) + "\n",
            substeps);
        double fastest = 0;
        for (int t = 0; t < 300; ++t) {
          world->Step();
          EXPECT_LT(Drift(*world), 1e-4) << ratio << swing << substeps << t;
          for (const BodyState& state : StatesOf(*world)) {
            fastest = std::max(fastest, double{state.velocity.norm()});
          }
        }
        EXPECT_LT(fastest, 15) << ratio << swing << substeps;
        EXPECT_GT(double{(world->Read(1).position - Vec2(3, 2)).norm()}, 0.019);
        if (*swing != 0) continue;
        EXPECT_NEAR(double{world->Read(1).position.y()}, 1.98, 1e-3) << ratio << substeps;
        EXPECT_LT(double{world->Read(0).velocity.norm()}, 1e-3) << ratio << substeps;
      }
    }
  }
}

TEST(ExactEnergy, ABodyPulledPastAPulleyGainsNoEnergy) {
  // Two bodies that motors hold against each other; the rope comes from within reach of one.
  const auto world = ExactWorld(
      PartText("post", "box = [0.4, 0.4]\nanchored = true\nposition = [0, 4]\ngroup = -1") +
          PartText("post2", "box = [0.4, 0.4]\nanchored = true\nposition = [2, 4]\ngroup = -1") +
          PartText("a",
                   "box = [0.76, 0.85]\nposition = [1.85, 1.01]\nangle = -0.9\ndensity = 0.26\n"
                   "velocity = [1.11, -1.42]\ngroup = -1") +
          PartText("b",
                   "box = [0.38, 1]\nposition = [2.45, 1.17]\nangle = -0.67\ndensity = 0.57\n"
                   "velocity = [2.02, 1.55]\ngroup = -1") +
          HingeText("hinge", "b", "a", 2.51, 0.61,
                    "limits = [-0.12, 0.31]\nmotor = {speed = 10.73, torque = 20.16}") +
          "[[joint]]\nname = \"hold\"\nkind = \"motor\"\na = \"a\"\nb = \"b\"\nforce = 135.28\n"
          "torque = 230.09\n"
          "[[joint]]\nname = \"rope\"\nkind = \"pulley\"\na = \"post2\"\nb = \"b\"\n"
          "ground_a = [2.36, 5.89]\nground_b = [2.8, 2.36]\nratio = 0.18\n"
          "[[joint]]\nname = \"spring\"\nkind = \"distance\"\na = \"post\"\nb = \"b\"\n"
          "frequency = 4.95\ndamping_ratio = 0.66\n",
      "joint_substeps = 1\n");
  for (int t = 0; t < 360; ++t) {
    world->Step();
    for (const BodyState& state : StatesOf(*world)) ASSERT_LT(state.velocity.norm(), 10) << t;
  }
  EXPECT_LT(Drift(*world), 1e-5);
}

}  // namespace exact_energy_test
}  // namespace seam
