#include "tests/lab/relief/relief_scene.h"

#include <fmt/format.h>

#include <algorithm>

namespace seam {
namespace {

/// The car of scenes/derby.toml. {0}: players, {1}: m between them.
constexpr const char* kCar = R"(
[[part]]
name = "car"
polygon = [[-1.6, -0.3], [1.6, -0.3], [1.9, 0], [1.4, 0.35], [-1.4, 0.35], [-1.9, 0]]
position = [0, 0.75]
density = 2
friction = 0.2
owners = ["p-*"]
repeat = {{count = {0}, step = [{1}, 0]}}
[[part]]
name = "rear"
circle = 0.4
position = [-1.1, 0.42]
friction = 0.9
repeat = {{count = {0}, step = [{1}, 0]}}
[[part]]
name = "front"
circle = 0.4
position = [1.1, 0.42]
friction = 0.9
repeat = {{count = {0}, step = [{1}, 0]}}
[[joint]]
name = "rear-axle"
kind = "wheel"
a = "car.0"
b = "rear.0"
frequency = 5
motor = {{player = "p-0", speed = -16, torque = 30}}
repeat = {{count = {0}, step = [{1}, 0]}}
[[joint]]
name = "front-axle"
kind = "wheel"
a = "car.0"
b = "front.0"
frequency = 5
motor = {{player = "p-0", speed = -16, torque = 30}}
repeat = {{count = {0}, step = [{1}, 0]}}
)";

/// The sled of scenes/swarm.toml.
constexpr const char* kSled = R"(
[[part]]
name = "car"
polygon = [[-1, -0.25], [1, -0.25], [1.3, 0.1], [1.2, 0.35], [-1.2, 0.35], [-1.3, 0.1]]
position = [0, 0.27]
density = 4
friction = 0.6
conveyor = {{player = "p-0", speed = 3}}
owners = ["p-*"]
repeat = {{count = {0}, step = [{1}, 0]}}
)";

/// One of each player's things. {2}: its number, {3}, {4}: m from the player's start.
constexpr const char* kCrate = R"(
[[part]]
name = "thing-{2}"
box = [0.7, 0.7]
position = [{3:.2f}, {4:.2f}]
density = 0.5
friction = 0.3
repeat = {{count = {0}, step = [{1}, 0]}}
)";
constexpr const char* kBall = R"(
[[part]]
name = "thing-{2}"
circle = 0.4
position = [{3:.2f}, {4:.2f}]
velocity = [0.3, 0]
restitution = 0.9
friction = 0
repeat = {{count = {0}, step = [{1}, 0]}}
)";

}  // namespace

std::string ReliefText(const ReliefRoom& room) {
  const bool crates = room.things == ReliefThings::kCrates;
  const float end = room.spacing * static_cast<float>(room.players) + 60;
  std::string text = fmt::format(
      "title = \"Relief: {0} players, {2} bodies each\"\nduration = 20\nbuffer = 8\n"
      "bounds = [[-100, -50], [{3:.0f}, 200]]\n[solver]\nsubsteps = 2\nsleep = {4}\n"
      "[[player]]\nname = \"p\"\nvehicle = \"car.0\"\nrepeat = {{count = {0}, step = [{1}, 0]}}\n"
      "script = [[0.0, {{}}], [0.5, {{drive = 1.0}}], [4.0, {{drive = -0.8}}], [8.0, {{drive = "
      "1.0}}], [12.0, {{drive = -0.8}}], [16.0, {{}}]]\n"
      "[[part]]\nname = \"ground\"\nchain = [[-90, 20], [-90, 0], [{5:.0f}, 0], [{5:.0f}, 20]]\n"
      "friction = 0.8\n",
      room.players, room.spacing, room.each, end, room.sleep, end - 10);
  text += fmt::format(fmt::runtime(crates ? kCar : kSled), room.players, room.spacing);
  const int things = std::max(0, room.each - (crates ? 3 : 1));
  // From one vehicle's nose to the next one's tail.
  const int columns = crates ? (things + 2) / 3 : things;
  const float step = std::max(0.85f, (room.spacing - 7) / static_cast<float>(std::max(1, columns)));
  for (int i = 0; i < things; ++i) {
    const int column = crates ? i / 3 : i;
    const float x = 4 + step * static_cast<float>(column);
    const float y = crates ? 0.36f + 0.71f * static_cast<float>(i % 3) : 4;
    text += fmt::format(fmt::runtime(crates ? kCrate : kBall), room.players, room.spacing, i, x, y);
  }
  return text;
}

}  // namespace seam
