/// What a slow belt carries or a slow motor drives does not sleep.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/scripted_world.h"

namespace seam {
namespace slow_drive_test {

const std::string kAnn = "[[player]]\nname = \"ann\"\n";

/// Runs a scene for so many seconds.
struct SlowRun : ScriptedWorld {
  SlowRun(const std::string& scene, double seconds)
      : ScriptedWorld(ParseScene(scene, "test.toml")) {
    StepTo(std::llround(seconds * world.scene().solver.tick_hz));
  }
};

std::string Box(const std::string& more) {
  return "[[part]]\nname = \"box\"\nbox = [1, 1]\n" + more + "\n";
}

TEST(SlowDrive, ASlowBeltCarriesABox) {
  for (const double speed : {0.002, 0.006, 0.0095}) {
    const std::string belt =
        "[[part]]\nname = \"belt\"\nbox = [20, 1]\nanchored = true\nconveyor = " +
        std::to_string(speed) + "\n";
    for (const char* shape : {"", "repeat = {count = [1, 3], step = [0, 1.01]}\n"}) {
      const SlowRun run(kAnn + belt + Box("position = [0, 1.015]\n" + std::string(shape)), 20);
      const char* const name = *shape == '\0' ? "box" : "box.0.0";
      EXPECT_NEAR(run.Read(name).position.x(), speed * 20, 0.02 * speed * 20) << speed;
    }
  }
}

TEST(SlowDrive, ASlowMotorLiftsAnArmAndDrivesACart) {
  for (const double spin : {0.003, 0.01}) {
    const SlowRun run(kAnn + R"(
[[part]]
name = "post"
box = [0.2, 0.2]
anchored = true
[[part]]
name = "arm"
box = [2, 0.2]
position = [1, 0]
[[joint]]
name = "hinge"
kind = "hinge"
a = "post"
b = "arm"
anchor = [0, 0]
motor = {torque = 100, speed = )" +
                          std::to_string(spin) + "}\n",
                      20);
    EXPECT_NEAR(run.Read("arm").angle, spin * 20, 0.02 * spin * 20);
  }
  const std::string wheel = R"([[joint]]
kind = "hinge"
a = "box"
motor = {speed = -0.016, torque = 100}
)";
  const SlowRun cart(kAnn + "[[part]]\nname = \"ground\"\nchain = [[-90, 0], [90, 0]]\n" +
                         Box("position = [0, 1.2]") + R"([[part]]
name = "w1"
circle = 0.5
position = [-0.8, 0.5]
group = -1
[[part]]
name = "w2"
circle = 0.5
position = [0.8, 0.5]
)" + wheel + "name = \"j1\"\nb = \"w1\"\n" +
                         wheel + "name = \"j2\"\nb = \"w2\"\n",
                     60);
  EXPECT_NEAR(cart.Read("box").position.x(), 0.008 * 60, 0.02);
}

}  // namespace slow_drive_test
}  // namespace seam
