#include "tests/lab/relief/relief_scene.h"

#include <fmt/format.h>

#include <algorithm>

namespace seam {
namespace {

/// The car of scenes/derby.toml. {0}: players, {1}: m between them, {2}: the plain, {3}: its
/// height.
constexpr const char* kCar = R"(
[[part]]
name = "car{2}"
polygon = [[-1.6, -0.3], [1.6, -0.3], [1.9, 0], [1.4, 0.35], [-1.4, 0.35], [-1.9, 0]]
position = [0, {3}.75]
density = 2
friction = 0.2
owners = ["p{2}-*"]
repeat = {{count = {0}, step = [{1}, 0]}}
[[part]]
name = "rear{2}"
circle = 0.4
position = [-1.1, {3}.42]
friction = 0.9
repeat = {{count = {0}, step = [{1}, 0]}}
[[part]]
name = "front{2}"
circle = 0.4
position = [1.1, {3}.42]
friction = 0.9
repeat = {{count = {0}, step = [{1}, 0]}}
[[joint]]
name = "rear-axle{2}"
kind = "wheel"
a = "car{2}.0"
b = "rear{2}.0"
frequency = 5
motor = {{player = "p{2}-0", speed = -16, torque = 30}}
repeat = {{count = {0}, step = [{1}, 0]}}
[[joint]]
name = "front-axle{2}"
kind = "wheel"
a = "car{2}.0"
b = "front{2}.0"
frequency = 5
motor = {{player = "p{2}-0", speed = -16, torque = 30}}
repeat = {{count = {0}, step = [{1}, 0]}}
)";

/// The sled of scenes/swarm.toml.
constexpr const char* kSled = R"(
[[part]]
name = "car{2}"
polygon = [[-1, -0.25], [1, -0.25], [1.3, 0.1], [1.2, 0.35], [-1.2, 0.35], [-1.3, 0.1]]
position = [0, {3}.27]
density = 4
friction = 0.6
conveyor = {{player = "p{2}-0", speed = 3}}
owners = ["p{2}-*"]
repeat = {{count = {0}, step = [{1}, 0]}}
)";

/// One of each player's things. {4}: its number, {5}, {6}: where the first one is.
constexpr const char* kCrate = R"(
[[part]]
name = "thing{2}-{4}"
box = [0.7, 0.7]
position = [{5:.2f}, {6:.2f}]
density = 0.5
friction = 0.3
repeat = {{count = {0}, step = [{1}, 0]}}
)";
constexpr const char* kBall = R"(
[[part]]
name = "thing{2}-{4}"
circle = 0.4
position = [{5:.2f}, {6:.2f}]
velocity = [0.3, 0]
restitution = 0.9
friction = 0
repeat = {{count = {0}, step = [{1}, 0]}}
)";

/// Its players, and the beginning of its ground.
constexpr const char* kRow = R"(
[[player]]
name = "p{2}"
vehicle = "car{2}.0"
repeat = {{count = {0}, step = [{1}, 0]}}
script = [[0.0, {{}}], [0.5, {{drive = 1.0}}], [4.0, {{drive = -0.8}}], [8.0, {{drive = 1.0}}],
          [12.0, {{drive = -0.8}}], [16.0, {{}}]]
[[part]]
name = "ground{2}"
)";
/// The lowest plain has walls, and is solid below.
constexpr const char* kLowest =
    "chain = [[-90, 20], [-90, 0], [{0:.0f}, 0], [{0:.0f}, 20]]\nfriction = 0.8\n";
constexpr const char* kHigher = "segment = [[-90, {1}], [{0:.0f}, {1}]]\nfriction = 0.8\n";
/// m; plains one above another are out of each other's interest.
constexpr int kPlainApart = 300;

/// Adds a plain with so many players: `name` is part of all names on it.
void AddPlain(const ReliefRoom& room, int players, const std::string& name, int height,
              std::string* text) {
  const bool crates = room.things == ReliefThings::kCrates;
  const float end = room.spacing * static_cast<float>(players) + 50;
  *text += fmt::format(fmt::runtime(kRow), players, room.spacing, name);
  *text += fmt::format(fmt::runtime(height == 0 ? kLowest : kHigher), end, height);
  *text += fmt::format(fmt::runtime(crates ? kCar : kSled), players, room.spacing, name, height);
  const int things = std::max(0, room.each - (crates ? 3 : 1));
  // From one vehicle's nose to the next one's tail.
  const int columns = crates ? (things + 2) / 3 : things;
  const float step = std::max(0.85f, (room.spacing - 7) / static_cast<float>(std::max(1, columns)));
  for (int i = 0; i < things; ++i) {
    const int column = crates ? i / 3 : i;
    const float x = 4 + step * static_cast<float>(column);
    const float y = crates ? 0.36f + 0.71f * static_cast<float>(i % 3) : 4;
    *text += fmt::format(fmt::runtime(crates ? kCrate : kBall), players, room.spacing, name, height,
                         i, x, y + static_cast<float>(height));
  }
}

}  // namespace

std::string ReliefText(const ReliefRoom& room) {
  const int columns = (room.players + room.plains - 1) / room.plains;
  const float end = room.spacing * static_cast<float>(columns) + 60;
  std::string text = fmt::format(
      "title = \"Relief: {} players, {} bodies each\"\nduration = 20\nbuffer = 8\n"
      "bounds = [[-100, -50], [{:.0f}, {}]]\n[solver]\nsubsteps = 2\nsleep = {}\n",
      room.players, room.each, end, 200 + kPlainApart * (room.plains - 1), room.sleep);
  for (int plain = 0; plain < room.plains; ++plain) {
    const int here = room.players / room.plains + (plain < room.players % room.plains ? 1 : 0);
    const std::string name = plain == 0 ? "" : std::string(1, static_cast<char>('a' + plain));
    AddPlain(room, here, name, kPlainApart * plain, &text);
  }
  return text;
}

}  // namespace seam
