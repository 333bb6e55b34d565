/// [[player]] with `repeat`: the copies and the contents of each.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/base/check.h"
#include "common/scene/part_rules.h"
#include "common/scene/player_colours.h"
#include "common/scene/scene.h"

namespace seam {
namespace player_repeat_test {

/// Returns the error of a scene; "" if it is valid.
std::string WhatIsWrong(const std::string& text) {
  try {
    ParseScene(text, "x.toml");
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* kRow = R"(
[[player]]
name = "ann"
colour = 4
[[player]]
name = "bot"
repeat = {count = 3, step = [10, 0]}
vehicle = "car.0"
region = [[0, 0], [8, 8]]
colour = 7
actions = [{button = 1, part = "car.0", impulse = [0, 1]}]
script = [[0, {drive = 1}]]
[[part]]
name = "car"
box = [1, 1]
repeat = {count = 3, step = [10, 0]}
owners = ["bot-*"]
[[part]]
name = "wheel"
circle = 0.3
position = [0, -1]
repeat = {count = 3, step = [10, 0]}
[[joint]]
name = "axle"
kind = "revolute"
a = "car.0"
b = "wheel.0"
anchor = [0, -1]
motor = {player = "bot-0", speed = 3, torque = 4}
repeat = {count = 3, step = [10, 0]}
)";

const Part& PartOf(const Scene& scene, PartId part) {
  return scene.parts[static_cast<std::size_t>(part)];
}

TEST(PlayerRepeat, EachCopyHasTheNextVehicleRegionActionAndMotor) {
  const Scene scene = ParseScene(kRow, "row.toml");
  ASSERT_EQ(scene.players.size(), 4u);
  ASSERT_EQ(scene.joints.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const Player& bot = scene.players[static_cast<std::size_t>(i) + 1];
    const std::string number = std::to_string(i);
    EXPECT_EQ(bot.name, "bot-" + number);
    EXPECT_EQ(PartOf(scene, bot.vehicle).name, "car." + number);
    EXPECT_EQ(PartOf(scene, bot.vehicle).owner, i + 1);
    EXPECT_EQ(PartOf(scene, bot.actions[0].part).name, "car." + number);
    EXPECT_EQ(bot.region_min, Vec2(10 * static_cast<float>(i), 0));
    EXPECT_EQ(bot.region_max, Vec2(10 * static_cast<float>(i) + 8, 8));
    EXPECT_EQ(bot.script.size(), 1u);
    EXPECT_EQ(scene.joints[static_cast<std::size_t>(i)].motor_player, i + 1);
  }
  EXPECT_EQ(PlayerColours(scene), (std::vector<std::string>{"4", "7", "7", "7"}));
}

TEST(PlayerRepeat, AGridIsNumberedAsPartsAre) {
  const Scene scene = ParseScene(R"(
[[player]]
name = "p"
repeat = {count = [3, 2], step = [5, 7]}
vehicle = "car.0.0"
[[part]]
name = "car"
box = [1, 1]
repeat = {count = [3, 2], step = [5, 7]}
[[part]]
name = "gate"
box = [1, 1]
position = [0, 50]
permissions = {push = ["p-*"], drive = ["p-2-1"]}
)",
                                 "grid.toml");
  ASSERT_EQ(scene.players.size(), 6u);
  EXPECT_EQ(scene.players[0].name, "p-0-0");
  EXPECT_EQ(scene.players[1].name, "p-0-1");
  EXPECT_EQ(scene.players[5].name, "p-2-1");
  for (const Player& player : scene.players) {
    std::string vehicle = "car" + player.name.substr(1);
    std::replace(vehicle.begin(), vehicle.end(), '-', '.');
    EXPECT_EQ(PartOf(scene, player.vehicle).name, vehicle);
  }
  const PartRules& rules = *scene.parts.back().rules;
  for (int player = 0; player < 6; ++player) {
    EXPECT_TRUE(Allows(rules.push, player));
    EXPECT_EQ(Allows(rules.drive, player), player == 5);
  }
  EXPECT_FALSE(Allows(rules.push, -1)) << "all of the players are not everybody";
}

TEST(PlayerRepeat, KeepsAVehicleThatIsNoCopyAndAnOmittedStep) {
  const Scene scene = ParseScene(R"(
[[player]]
name = "p"
repeat = {count = 2}
region = [[0, 0], [1, 1]]
actions = [{button = 0, part = "ball", impulse = [1, 0]}]
[[part]]
name = "ball"
circle = 1
)",
                                 "ball.toml");
  EXPECT_EQ(scene.players[1].region_min, Vec2(0, 0));
  EXPECT_EQ(scene.players[1].actions[0].part, 0);
}

/// The complaint about the row of above with `from` replaced by `to`.
std::string Complaint(const std::string& from, const std::string& to) {
  std::string text = kRow;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "there is no " + from;
  text.replace(at, from.size(), to);
  return WhatIsWrong(text);
}

TEST(PlayerRepeat, MistakesNameTheirLine) {
  const std::string repeat = "repeat = {count = 3, step = [10, 0]}";
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(Complaint(repeat, "repaet = {count = 3}"), "did you mean 'repeat'");
  says(Complaint(repeat, "repeat = {count = 3, stpe = [1, 0]}"), "did you mean 'step'");
  says(Complaint(repeat, "repeat = {step = [1, 0]}"), "count is missing");
  says(Complaint(repeat, "repeat = {count = 0}"), "count must be an integer from 1");
  says(Complaint(repeat, "repeat = {count = [2, 1.5]}"), "count must be integers");
  says(Complaint(repeat, "repeat = {count = 3, weld = true}"), "only parts are welded or glued");
  says(Complaint(repeat, "repeat = {count = 4}"), "repeat: there is no part 'car.3'");
  says(Complaint(repeat, "repeat = {count = [3, 1]}"), "there is no player 'bot-0'");
  says(Complaint(repeat, "repeat = {count = 2}"), "repeat: there is no player 'bot-2'");
  says(Complaint("name = \"ann\"", "name = \"bot-1\""), "another player of this name");
  says(Complaint("player = \"bot-0\"", "player = \"bot\""), "say 'bot-0' for one of them");
  says(Complaint("\"bot-*\"", "\"ann-*\""), "no player is repeated as 'ann-*'");
  says(Complaint("\"bot-*\"", "\"bot\""), "'bot' is repeated");
  says(WhatIsWrong(R"(
[[player]]
name = "p"
repeat = {count = [2, 1]}
vehicle = "car.0"
[[part]]
name = "car"
box = [1, 1]
repeat = {count = 2, step = [5, 0]}
)"),
       "player 'p': repeat: 'car.0' is not repeated the same way");
  const std::string longest(32, 'x');
  says(Complaint("name = \"bot\"", "name = \"" + longest + "\""), "is too long");
}

/// So many players in a row.
Scene Row(int players, int apart_m, const std::string& top) {
  const std::string count = std::to_string(players);
  return ParseScene(top + "\n[[player]]\nname = \"p\"\nrepeat = {count = " + count +
                        "}\nvehicle = \"car.0\"\n[[part]]\nname = \"car\"\nbox = [1, 1]\n" +
                        "repeat = {count = " + count + ", step = [" + std::to_string(apart_m) +
                        ", 0]}\n",
                    "x.toml");
}

TEST(PlayerRepeat, ARoomOfDistantPlayersIsFollowedWholeIfItHasFewBodies) {
  EXPECT_EQ(Row(16, 50, "").follow_bodies, 256);
  EXPECT_EQ(Row(32, 7, "").follow_bodies, 256) << "217 m";
  EXPECT_EQ(Row(32, 8, "").follow_bodies, 128) << "248 m";
  EXPECT_EQ(Row(32, 8, "").server_follow, 128);
  EXPECT_EQ(Row(64, 8, "").follow_bodies, 64);
  EXPECT_EQ(Row(64, 8, "follow = 200").follow_bodies, 200);
  EXPECT_EQ(Row(64, 8, "follow = 200").server_follow, 64);
  EXPECT_EQ(Row(32, 8, "planner = {hear = 200}").follow_bodies, 256);
}

}  // namespace player_repeat_test
}  // namespace seam
