/// Slow bodies that would not stay where they are do not sleep; others sleep.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/scripted_world.h"

namespace seam {
namespace slow_watch_test {

const std::string kAnn = "[[player]]\nname = \"ann\"\n";
const std::string kGround = R"(
[[part]]
name = "ground"
chain = [[-90, 0], [90, 0]]
friction = 0
)";

/// Runs a scene for so many seconds.
struct SlowRun : ScriptedWorld {
  SlowRun(const std::string& scene, double seconds)
      : ScriptedWorld(ParseScene(scene, "test.toml")) {
    StepTo(std::llround(seconds * world.scene().solver.tick_hz));
  }
  bool Sleeps(const std::string& part) const { return !world.awake(Body(part)); }
};

std::string Box(const std::string& more) {
  return "[[part]]\nname = \"box\"\nbox = [1, 1]\n" + more + "\n";
}

/// A spring of 3 m from a post to the box.
std::string Spring(const std::string& frequency_hz, const std::string& damping) {
  return "[[joint]]\nname = \"spring\"\nkind = \"distance\"\na = \"post\"\nb = \"box\"\nlength = "
         "3\n"
         "frequency = " +
         frequency_hz + "\ndamping_ratio = " + damping + "\n";
}

TEST(SlowWatch, NothingSleepsInTheAir) {
  for (const double g : {0.015, 0.002}) {
    const SlowRun run(
        "gravity = [0, -" + std::to_string(g) + "]\n" + kAnn + Box("position = [0, 50]"), 20);
    EXPECT_NEAR(run.Read("box").position.y(), 50 - g * 200, 0.02 * g * 200) << g;
  }
}

/// It is slower than the engine's tolerance for 1.3 s about the apex.
TEST(SlowWatch, ABodyThrownUpSlowlyComesDownAgain) {
  const SlowRun run(
      "gravity = [0, -0.015]\n" + kAnn + Box("position = [0, 50]\nvelocity = [0, 0.06]"), 10);
  EXPECT_NEAR(run.Read("box").position.y(), 50 + 0.6 - 0.75, 0.01);
}

TEST(SlowWatch, AWeakThrustMovesABodyInTheAirAndOnIce) {
  const std::string thrust = "[[thrust]]\nname = \"t\"\npart = \"box\"\nforce = [0.01, 0]\n";
  const SlowRun free("gravity = [0, 0]\n" + kAnn + Box("") + thrust, 20);
  EXPECT_NEAR(free.Read("box").position.x(), 2, 0.01);
  const SlowRun ice(kAnn + kGround + Box("position = [0, 0.505]\nfriction = 0") + thrust, 20);
  EXPECT_NEAR(ice.Read("box").position.x(), 2, 0.05);
}

TEST(SlowWatch, ABodyThatDriftsOrTurnsFreelyGoesOn) {
  const std::string space = "gravity = [0, 0]\n" + kAnn;
  const SlowRun drifts(space + Box("velocity = [0.009, 0]"), 20);
  EXPECT_NEAR(drifts.Read("box").position.x(), 0.18, 1e-4);
  const SlowRun turns(space + Box("spin = 0.03"), 20);
  EXPECT_NEAR(turns.Read("box").angle, 0.6, 1e-3);
  const SlowRun both(space + Box("velocity = [0.004, 0]\nrepeat = {count = 2, step = [0, 1]}"), 20);
  EXPECT_NEAR(both.Read("box.0").position.x(), 0.08, 1e-3) << "two that touch drift as well";
}

TEST(SlowWatch, ABodyThatNothingMovesSleepsInTheAir) {
  const SlowRun run("gravity = [0, 0]\n" + kAnn + Box(""), 1);
  EXPECT_TRUE(run.Sleeps("box"));
}

/// The spring's force is balanced by its damper while the body creeps towards its rest.
TEST(SlowWatch, ABodyOnAnOverdampedSpringReachesItsRest) {
  const SlowRun run("gravity = [0, 0]\n" + kAnn + R"(
[[part]]
name = "post"
box = [0.4, 0.4]
position = [-3, 0]
anchored = true
)" + Box("position = [0.3, 0]") +
                        Spring("0.3", "10"),
                    60);
  EXPECT_NEAR(run.Read("box").position.x(), 0, 0.006);
  EXPECT_TRUE(run.Sleeps("box"));
}

TEST(SlowWatch, ABodySinksThroughThickWaterToTheGround) {
  const std::string scene = kAnn + R"(
[[part]]
name = "ground"
chain = [[-90, -1], [90, -1]]
[[water]]
name = "honey"
box = [40, 3]
position = [0, 0.5]
viscosity = 200
)";
  for (const char* rest :
       {"position = [0, 0]", "position = [0, 0]\nrepeat = {count = 2, step = [0, 1.01]}"}) {
    const bool two = std::string(rest).find("repeat") != std::string::npos;
    const std::string name = two ? "box.0" : "box";
    const SlowRun run(scene + Box("density = 1.05\n" + std::string(rest)), 10);
    EXPECT_NEAR(run.Read(name).position.y(), -0.0025 * 10, 0.004) << "0.05 g / 200 = 2.5 mm/s";
    EXPECT_FALSE(run.Sleeps(name));
  }
}

/// At 5 mm/s, in g = 10: the weight is carried by the motor.
TEST(SlowWatch, AMotorThatMovesSlowlyGoesOn) {
  const SlowRun run(kAnn + R"(
[[part]]
name = "post"
box = [0.4, 0.4]
position = [-3, 0]
anchored = true
)" + Box("") + R"([[joint]]
name = "slide"
kind = "prismatic"
a = "post"
b = "box"
axis = [0, 1]
motor = {speed = 0.005, force = 1000}
)",
                    20);
  EXPECT_NEAR(run.Read("box").position.y(), 0.1, 0.002);
}

/// Returns the places of the box in each second of a minute that begins after ten: it has swung for
/// a while.
std::vector<float> Swing(const std::string& scene) {
  SlowRun run(scene, 10);
  std::vector<float> places;
  for (int s = 0; s < 60; ++s) {
    run.StepTo((11 + s) * run.world.scene().solver.tick_hz);
    places.push_back(run.Read("box").position.x());
  }
  return places;
}

/// Near a turning point they are slower than the engine's tolerances for longer than it waits.
TEST(SlowWatch, ASlowSwingGoesOnPastItsTurningPoints) {
  const std::string post = "[[part]]\nname = \"post\"\nbox = [0.2, 0.2]\nanchored = true\n";
  const std::string pendulum = kAnn + post + "[[joint]]\nname = \"pin\"\nkind = \"hinge\"\n" +
                               "a = \"post\"\nb = \"box\"\nanchor = [0, 0]\n";
  const auto spring = [&](float by, float hz) {
    return "gravity = [0, 0]\n" + kAnn + post +
           Box("position = [" + std::to_string(3 + by) + ", 0]") +
           "[[joint]]\nname = \"way\"\nkind = \"prismatic\"\na = \"post\"\n" +
           "b = \"box\"\naxis = [1, 0]\n[[joint]]\nname = \"spring\"\nkind = \"distance\"\n" +
           "a = \"post\"\nb = \"box\"\nlength = 3\nfrequency = " + std::to_string(hz) +
           "\ndamping_ratio = 0\n";
  };
  struct Case {
    std::string scene;
    float middle, least;
  };
  const std::vector<Case> cases = {
      {pendulum + Box("position = [0.008, -2]"), 0, 0.005F},
      {pendulum + Box("position = [0.02, -9]"), 0, 0.013F},
      {spring(0.03F, 0.07F), 3, 0.015F},
      {spring(0.02F, 0.1F), 3, 0.01F},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.scene);
    const std::vector<float> places = Swing(c.scene);
    const auto [left, right] = std::minmax_element(places.begin(), places.end());
    EXPECT_LT(*left, c.middle - c.least);
    EXPECT_GT(*right, c.middle + c.least);
  }
}

TEST(SlowWatch, ADampedSwingComesToRestInTheMiddle) {
  const SlowRun run(kAnn + R"(
[[part]]
name = "post"
box = [0.2, 0.2]
position = [0, 3]
anchored = true
)" + Box("position = [0, 0.1]") +
                        Spring("1", "0.2"),
                    20);
  EXPECT_TRUE(run.Sleeps("box"));
  EXPECT_NEAR(run.Read("box").position.y(), -10 / 39.48, 0.02) << "g / (2 pi f)^2 below";
}

/// Returns the largest angle of the pole within 10 s, rad.
float LargestAngle(const std::string& scene) {
  SlowRun run(kAnn + scene, 0);
  float largest = 0;
  for (int i = 0; i < 600; ++i) {
    run.Step();
    largest = std::max(largest, std::fabs(run.Read("pole").angle));
  }
  return largest;
}

/// A pole of 2 m that leans by 1 or 0.1 mrad on a hinge, or stands on a round foot.
TEST(SlowWatch, ALeaningPoleFalls) {
  for (const std::string lean : {"0.001", "0.0001"}) {
    EXPECT_GT(LargestAngle(R"(
[[part]]
name = "base"
box = [1, 0.2]
position = [0, -0.1]
anchored = true
[[part]]
name = "pole"
box = [0.1, 2]
position = [-)" + lean +
                           ", 1]\nangle = " + lean + R"(
[[joint]]
name = "hinge"
kind = "hinge"
a = "base"
b = "pole"
anchor = [0, 0]
)"),
              1.5)
        << lean;
  }
  EXPECT_GT(LargestAngle(kGround + R"(
[[part]]
name = "pole"
box = [0.1, 2]
position = [0, 1.2]
angle = 0.001
[[part]]
name = "foot"
circle = 0.2
position = [0.001, 0.205]
[[joint]]
name = "w"
kind = "weld"
a = "pole"
b = "foot"
)"),
            1.5);
}

/// A ball that rolls on a floor at 6 mm/s without end is the engine's, too: rolling has no
/// friction.
TEST(SlowWatch, ABallComesToRestInABowl) {
  const SlowRun run(kAnn + R"(
[[part]]
name = "bowl"
chain = [[-5, 5], [-4, 1], [4, 1], [5, 5], [5, 0], [-5, 0], [-5, 5]]
[[part]]
name = "ball"
circle = 1
restitution = 0.75
position = [0, 10]
velocity = [-5.3, -2.1]
)",
                    30);
  EXPECT_TRUE(run.Sleeps("ball"));
}

/// First time at which everything sleeps, s.
double AsleepAt(const std::string& scene, double most_s) {
  ScriptedWorld run(LoadScene("scenes/" + scene + ".toml"));
  const double hz = run.world.scene().solver.tick_hz;
  for (int tick = 1; tick <= most_s * hz; ++tick) {
    run.Step();
    bool awake = false;
    for (int body = 0; body < run.world.body_count(); ++body) {
      awake = awake || run.world.awake(body);
    }
    if (!awake) return tick / hz;
  }
  return 1e9;
}

/// Times of 0.23.0, which looked at speed alone; of the card house and the wall 1.02 and 8.84,
/// whose contacts have another order since.
TEST(SlowWatch, PilesSleepAsSoonAsBySpeedAlone) {
  EXPECT_LE(AsleepAt("hard/tower-30", 10), 1.97);
  EXPECT_LE(AsleepAt("hard/pyramid-20", 10), 2.02);
  EXPECT_LE(AsleepAt("hard/card-house", 10), 1.26);
  EXPECT_LE(AsleepAt("hard/arch", 10), 1.32);
  EXPECT_LE(AsleepAt("wall", 20), 9.51);
  EXPECT_LE(AsleepAt("heap", 20), 9.17);
}

TEST(SlowWatch, AReplayHasTheSameBits) {
  const Scene scene =
      ParseScene("gravity = [0, -0.015]\n" + kAnn + kGround +
                     Box("position = [0, 0.6]\nrepeat = {count = 3, step = [0.4, 1.2]}"),
                 "test.toml");
  World world(scene);
  std::vector<WorldSnapshot> barriers;
  std::vector<std::uint64_t> hashes;
  for (int tick = 1; tick <= 900; ++tick) {
    world.Step();
    if (tick % 10 == 0) barriers.push_back(world.Barrier());
    hashes.push_back(world.Hash());
  }
  for (std::size_t i = 0; i + 1 < barriers.size(); i += 7) {
    ASSERT_TRUE(world.Restore(barriers[i]).ok());
    while (world.tick() < barriers[i].tick + 60 && world.tick() < 900) {
      world.Step();
      if (world.tick() % 10 == 0) world.Barrier();
      ASSERT_EQ(world.Hash(), hashes[static_cast<std::size_t>(world.tick() - 1)]);
    }
  }
}

}  // namespace slow_watch_test
}  // namespace seam
