#pragma once
/// Scenes of a chosen length, for tests of long ones.

#include <cstddef>
#include <cstdio>
#include <string>

#include "common/base/random.h"

namespace seam {

/// Returns a scene of exactly `bytes` bytes, at least 1000: two players, a few moving boxes on the
/// ground, and anchored boxes in the air for the rest, each of another size and place.
inline std::string BigScene(std::size_t bytes) {
  std::string text =
      "bounds = [[-1000, -100], [1000, 9000]]\n[[player]]\nname = \"ann\"\n"
      "[[player]]\nname = \"bob\"\n[[part]]\nname = \"ground\"\nbox = [800, 1]\n"
      "position = [0, -0.5]\nanchored = true\n";
  Random random(7);
  for (int i = 0;; ++i) {
    const bool moves = i < 8;
    char part[200];
    std::snprintf(part, sizeof part,
                  "[[part]]\nname = \"%s%d\"\nbox = [%.3f, %.3f]\nposition = [%.3f, %.3f]\n%s",
                  moves ? "m" : "a", i, random.Uniform(0.3, 0.9), random.Uniform(0.3, 0.9),
                  (i % 380 - 190) * 2 + random.Uniform(-0.5, 0.5),
                  moves ? 1.0 : 20.0 + 2 * (i / 380),
                  i == 0   ? "owner = \"ann\"\n"
                  : i == 1 ? "owner = \"bob\"\n"
                  : moves  ? ""
                           : "anchored = true\n");
    if (text.size() + std::string(part).size() + 2 > bytes) break;
    text += part;
  }
  return text + "#" + std::string(bytes - text.size() - 2, 'x') + "\n";
}

}  // namespace seam
