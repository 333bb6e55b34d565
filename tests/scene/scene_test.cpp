/// Reads scenes from text.

#include "common/scene/scene.h"

#include <gtest/gtest.h>

#include "common/base/check.h"

namespace seam {
namespace scene_test {

TEST(Scene, ReadsEveryKey) {
  const Scene s = ParseScene(R"(
title = "All of it"
gravity = [0.5, -9.81]
duration = 2.5
buffer = 12
speed_limit = 80
size_max = 30
bounds = [[-50, -60], [70, 80]]
[solver]
tick_hz = 120
substeps = 3
velocity_iterations = 5
position_iterations = 2
sleep = false
continuous = false
[[player]]
name = "ann"
vehicle = "car"
region = [[-9, -8], [7, 6]]
actions = [{button = 3, part = "tower.1", impulse = [4, 5]}]
script = [[0, {drive = 1}], [0.5, {drive = -1, lift = 0.5, buttons = [0, 3]}]]
[[player]]
name = "bob"
[[part]]
name = "car"
box = [20, 1]
position = [1, 2]
angle = 0.25
density = 2
friction = 0.3
restitution = 0.4
bullet = true
group = -2
velocity = [3, -4]
spin = 5
owner = "ann"
[[part]]
name = "wheel"
circle = 0.4
position = [2, 1]
[[part]]
name = "tower"
polygon = [[0, 0], [1, 0], [0, 1]]
position = [10, 0]
repeat = {count = 3, step = [0, 1.5]}
owners = ["ann", "bob"]
[[part]]
name = "wall"
box = [1, 1]
position = [20, 0]
anchored = true
repeat = {count = [2, 2], step = [3, 4]}
[[part]]
name = "ground"
chain = [[-10, 0], [0, 1], [10, 0]]
[[joint]]
name = "axle"
kind = "wheel"
a = "car"
b = "wheel"
axis = [0, 2]
frequency = 4
damping_ratio = 0.5
collide = true
motor = {player = "bob", speed = -75, torque = 300}
[[joint]]
name = "hinge"
kind = "revolute"
a = "tower.0"
b = "ground"
anchor = [10, 1]
limits = [-0.5, 0.75]
[[joint]]
name = "rod"
kind = "distance"
a = "tower.1"
b = "ground"
anchor_b = [3, 4]
length = 6
[[watch]]
struck = ["tower.*", "car"]
around = 1.5
[camera]
min = [-5, -1]
max = [5, 9]
follow = "car"
)",
                             "folder/all.toml");
  EXPECT_EQ(s.name, "all");
  EXPECT_EQ(s.title, "All of it");
  EXPECT_EQ(s.gravity, Vec2(0.5f, -9.81f));
  EXPECT_EQ(s.duration_s, 2.5);
  EXPECT_EQ(s.buffer_m, 12);
  EXPECT_EQ(s.speed_limit, 80);
  EXPECT_EQ(s.bounds_min, Vec2(-50, -60));
  EXPECT_EQ(s.bounds_max, Vec2(70, 80));
  EXPECT_EQ(s.solver.tick_hz, 120);
  EXPECT_EQ(s.solver.substeps, 3);
  EXPECT_EQ(s.solver.velocity_iterations, 5);
  EXPECT_EQ(s.solver.position_iterations, 2);
  EXPECT_FALSE(s.solver.sleep || s.solver.continuous);

  ASSERT_EQ(s.parts.size(), 10u);
  const Part& car = s.parts[0];
  EXPECT_EQ(car.kind, ShapeKind::kBox);
  EXPECT_EQ(car.size, Vec2(20, 1));
  EXPECT_EQ(car.position, Vec2(1, 2));
  EXPECT_EQ(car.angle, 0.25f);
  EXPECT_EQ(car.material.density, 2);
  EXPECT_EQ(car.material.friction, 0.3f);
  EXPECT_EQ(car.material.restitution, 0.4f);
  EXPECT_TRUE(car.bullet);
  EXPECT_EQ(car.filter.group, -2);
  EXPECT_EQ(car.velocity, Vec2(3, -4));
  EXPECT_EQ(car.spin, 5);
  EXPECT_EQ(car.owner, 0);
  EXPECT_EQ(car.line, 24);
  EXPECT_EQ(s.parts[1].radius, 0.4f);
  EXPECT_EQ(s.parts[1].owner, -1);
  for (int i = 0; i < 3; ++i) {
    const Part& part = s.parts[static_cast<std::size_t>(2 + i)];
    EXPECT_EQ(part.name, "tower." + std::to_string(i));
    EXPECT_EQ(part.position, Vec2(10, 1.5f * static_cast<float>(i)));
    EXPECT_EQ(part.owner, i % 2);
    EXPECT_EQ(part.points.size(), 3u);
  }
  EXPECT_EQ(s.parts[6].name, "wall.0.1");
  EXPECT_EQ(s.parts[6].position, Vec2(20, 4));
  EXPECT_EQ(s.parts[7].name, "wall.1.0");
  EXPECT_EQ(s.parts[7].position, Vec2(23, 0));
  EXPECT_TRUE(s.parts[8].anchored && s.parts[9].anchored);

  ASSERT_EQ(s.joints.size(), 3u);
  EXPECT_EQ(s.joints[0].kind, JointKind::kWheel);
  EXPECT_EQ(s.joints[0].anchor_a, Vec2(2, 1));
  EXPECT_EQ(s.joints[0].axis, Vec2(0, 1));
  EXPECT_EQ(s.joints[0].frequency_hz, 4);
  EXPECT_EQ(s.joints[0].damping_ratio, 0.5f);
  EXPECT_TRUE(s.joints[0].collide);
  EXPECT_EQ(s.joints[0].motor_player, 1);
  EXPECT_EQ(s.joints[0].motor_speed, -75);
  EXPECT_EQ(s.joints[0].motor_torque, 300);
  EXPECT_TRUE(s.joints[1].limited);
  EXPECT_EQ(s.joints[1].lower, -0.5f);
  EXPECT_EQ(s.joints[1].upper, 0.75f);
  EXPECT_EQ(s.joints[2].anchor_a, Vec2(10, 1.5f));
  EXPECT_EQ(s.joints[2].anchor_b, Vec2(3, 4));
  EXPECT_EQ(s.joints[2].length, 6);

  ASSERT_EQ(s.players.size(), 2u);
  const Player& ann = s.players[0];
  EXPECT_EQ(ann.vehicle, 0);
  EXPECT_TRUE(ann.has_region);
  EXPECT_EQ(ann.region_min, Vec2(-9, -8));
  EXPECT_EQ(ann.region_max, Vec2(7, 6));
  ASSERT_EQ(ann.actions.size(), 1u);
  EXPECT_EQ(ann.actions[0].button, 3);
  EXPECT_EQ(ann.actions[0].part, 3);
  EXPECT_EQ(ann.actions[0].impulse, Vec2(4, 5));
  ASSERT_EQ(ann.script.size(), 2u);
  EXPECT_EQ(ann.script[0].input, (Input{127, 0, 0}));
  EXPECT_EQ(ann.script[1].from_tick, 60);
  EXPECT_EQ(ann.script[1].input, (Input{-127, 64, 9}));
  EXPECT_FALSE(s.players[1].has_region);
  ASSERT_EQ(s.watch.size(), 1u);
  EXPECT_EQ(s.watch[0].struck, (std::vector<PartId>{2, 3, 4, 0}));
  EXPECT_EQ(s.watch[0].around_tick, 180);
  EXPECT_EQ(s.camera.min, Vec2(-5, -1));
  EXPECT_EQ(s.camera.max, Vec2(5, 9));
  EXPECT_EQ(s.camera.follow, 0);
}

TEST(Scene, RefusesTextsThatNoMessageOrStackCanHold) {
  const auto says = [](const std::string& text, const char* phrase) {
    try {
      ParseScene(text, "s.toml");
    } catch (const OperatorError& e) {
      return std::string(e.what()).find(phrase) != std::string::npos;
    }
    return false;
  };
  constexpr std::size_t kLongest = 4000000;
  EXPECT_TRUE(says("#" + std::string(kLongest - 1, 'x') + "\n",
                   "s.toml:1: a scene may have at most 4000000 bytes; this one has more"));
  EXPECT_TRUE(says("#" + std::string(kLongest - 2, 'x') + "\n", "there is no [[part]]"));
  EXPECT_TRUE(says("a = " + std::string(40000, '['), "nested too deeply"));
  EXPECT_TRUE(says("a = " + std::string(40000, '{'), "nested too deeply"));
  std::string dots = "a";
  for (int i = 0; i < 20000; ++i) dots += ".a";
  EXPECT_TRUE(says(dots + " = 1", "too many dots"));
  EXPECT_TRUE(says("", "there is no [[part]]"));
  EXPECT_THROW(LoadScene("scenes/no_such_scene.toml"), OperatorError);
  EXPECT_THROW(LoadScene("scenes"), OperatorError);  // a folder
  EXPECT_THROW(LoadScene("/dev/zero"), OperatorError);
}

TEST(Scene, LimitsThemselvesAreAllowed) {
  EXPECT_NO_THROW(ParseScene("[[part]]\nname = \"p\"\nbox = [0.05, 10]\n", "s.toml"));
  EXPECT_NO_THROW(
      ParseScene("[solver]\nskin = 0.0025\n[[part]]\nname = \"p\"\ncircle = 0.025\n", "s.toml"));
  EXPECT_ANY_THROW(ParseScene("[[part]]\nname = \"p\"\nbox = [0.0499, 10]\n", "s.toml"));
}

}  // namespace scene_test
}  // namespace seam
