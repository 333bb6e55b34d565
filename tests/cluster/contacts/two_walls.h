#pragma once
/// The beginning of a scene without gravity: two elastic walls on both sides of the seam of two
/// players' regions.

#include <string>

namespace seam {

inline std::string TwoWalls(int duration_s) {
  return "duration = " + std::to_string(duration_s) + R"(
gravity = [0, 0]
[[player]]
name = "ann"
region = [[-200, -50], [-0.01, 100]]
[[player]]
name = "bob"
region = [[0, -50], [200, 100]]
[[part]]
name = "west"
box = [1, 20]
position = [-8, 0]
anchored = true
restitution = 1
friction = 0
[[part]]
name = "east"
box = [1, 20]
position = [8, 0]
anchored = true
restitution = 1
friction = 0
)";
}

}  // namespace seam
