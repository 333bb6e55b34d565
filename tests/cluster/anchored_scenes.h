#pragma once
/// Scenes in which glue holds bodies to anchored parts.

#include <cstdint>
#include <string>

#include "common/base/random.h"

namespace seam {

inline const char* const kThrower = R"(
[[player]]
name = "ann"
region = [[-1000, -1000], [-0.001, 1000]]
actions = [{button = 0, part = "ball", impulse = [160, 30]}]
script = [[0.0, {}], [0.5, {buttons = [0]}], [0.6, {}]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "ground"
chain = [[-30, 0], [60, 0]]
[[part]]
name = "ball"
circle = 0.5
position = [-8, 0.52]
density = 10
owner = "ann"
bullet = true
)";

/// A weight falls on a shelf that is glued to a wall.
inline const std::string kShelf = R"(
duration = 2
)" + std::string(kThrower) + R"(
[[part]]
name = "wall"
box = [0.4, 4]
position = [-2, 12]
anchored = true
[[part]]
name = "shelf"
box = [3, 0.2]
position = [-0.3, 12]
density = 0.5
[[joint]]
kind = "glue"
name = "peg"
a = "wall"
b = "shelf"
strength = 60
[[part]]
name = "weight"
box = [0.6, 0.6]
position = [0.6, 15]
density = 3
)";

/// A ball hits a wall of thirty bricks, of which one is glued to a foundation.
inline const std::string kFoundation = R"(
duration = 6
buffer = 12
)" + std::string(kThrower) + R"(
[[part]]
name = "base"
box = [2.1, 0.4]
position = [2.2, 0.2]
anchored = true
[[part]]
name = "wall"
box = [0.7, 0.5]
position = [1.5, 0.65]
density = 0.6
repeat = {count = [3, 10], step = [0.7, 0.5], glue = 60}
[[joint]]
name = "foot"
kind = "glue"
a = "base"
b = "wall.0.0"
strength = 60
)";

/// A ball is thrown at a glued post and stopped by its player just before it.
inline const std::string kStopped = R"(
duration = 3
buffer = 12
[[player]]
name = "ann"
region = [[-1000, -1000], [-0.001, 1000]]
actions = [{button = 0, part = "ball", impulse = [160, 0]},
           {button = 1, part = "ball", impulse = [-160, 0]}]
script = [[0.0, {}], [0.5, {buttons = [0]}], [0.6, {}], [0.9, {buttons = [1]}], [1.0, {}]]
[[player]]
name = "bob"
region = [[0, -1000], [1000, 1000]]
[[part]]
name = "ground"
chain = [[-30, 0], [60, 0]]
friction = 0
[[part]]
name = "ball"
circle = 0.5
position = [-8, 0.52]
density = 10
friction = 0
owner = "ann"
[[part]]
name = "base"
box = [1, 0.2]
position = [2.5, 0.1]
anchored = true
[[part]]
name = "post"
box = [0.3, 2]
position = [2.2, 1.2]
[[joint]]
name = "foot"
kind = "glue"
a = "base"
b = "post"
strength = 400
)";

/// Returns one of twenty scenes and more: a ball is thrown at, and a weight falls on, a structure
/// on anchored parts; its kind, size, strength and place by the seed.
inline std::string AnchoredScene(int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  const auto number = [&](double least, double most) {
    return std::to_string(least + (most - least) * random.Uniform());
  };
  std::string text = "duration = 3\nbuffer = 12\n" + std::string(kThrower);
  const double place = -2 + 6 * random.Uniform();
  const std::string x = std::to_string(place), strength = number(40, 400);
  const std::string at = "position = [" + x + ", ";
  int bonds = 0;
  const auto glue = [&](const std::string& a, const std::string& b) {
    text += "[[joint]]\nname = \"bond" + std::to_string(bonds++) + "\"\nkind = \"glue\"\na = \"" +
            a + "\"\nb = \"" + b + "\"\nstrength = " + strength + "\n";
  };
  const std::string rows = std::to_string(2 + seed % 5);
  switch (seed % 4) {
    case 0:  // a wall on a foundation
      text += "[[part]]\nname = \"base\"\nbox = [4, 0.4]\nanchored = true\n" + at + "0.2]\n";
      text += "[[part]]\nname = \"brick\"\nbox = [0.7, 0.5]\ndensity = 0.6\n" + at + "0.65]\n";
      text += "repeat = {count = [2, " + rows + "], step = [0.7, 0.5], glue = " + strength + "}\n";
      glue("base", "brick.0.0");
      glue("base", "brick.1.0");
      break;
    case 1:  // a balcony
      text += "[[part]]\nname = \"tower\"\nbox = [0.6, 6]\nanchored = true\n" + at + "6]\n";
      text += "[[part]]\nname = \"slab\"\nbox = [5, 0.2]\ndensity = 0.4\n" + at + "5]\n";
      glue("tower", "slab");
      break;
    case 2:  // lamps in a row below a beam
      text += "[[part]]\nname = \"beam\"\nbox = [6, 0.4]\nanchored = true\n" + at + "3]\n";
      text += "[[part]]\nname = \"lamp\"\nbox = [0.5, 1.4]\ndensity = 0.3\n" + at + "2.1]\n";
      text += "repeat = {count = " + rows + ", step = [0.5, 0]}\n";
      for (int i = 0; i < 2 + seed % 5; ++i) glue("beam", "lamp." + std::to_string(i));
      break;
    default:  // a post that carries a roof
      text += "[[part]]\nname = \"base\"\nbox = [1, 0.2]\nanchored = true\n" + at + "0.1]\n";
      text += "[[part]]\nname = \"post\"\nbox = [0.4, 2]\n" + at + "1.2]\n";
      text += "[[part]]\nname = \"roof\"\nbox = [3, 0.2]\n" + at + "2.3]\n";
      glue("base", "post");
      glue("post", "roof");
  }
  const std::string density = number(1, 5), height = number(10, 16);
  const std::string above = std::to_string(place + (seed % 4 == 1 ? 1.5 : 0));
  text += "[[part]]\nname = \"weight\"\nbox = [0.6, 0.6]\ndensity = " + density + "\nposition = [" +
          above + ", " + height + "]\n";
  return text;
}

}  // namespace seam
