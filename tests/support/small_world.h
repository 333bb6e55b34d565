#pragma once
/// Worlds from a few lines of scene text, for tests.

#include <cmath>
#include <memory>
#include <string>

#include "common/physics/world.h"

namespace seam {

/// Makes a world: `solver` are lines of [solver], `parts` is the rest of the scene. Sleeping is
/// off, so no slow body is stopped.
inline std::unique_ptr<World> SmallWorld(const std::string& parts, const std::string& solver = "",
                                         const std::string& top = "") {
  const Scene scene =
      ParseScene(top + "\n[solver]\nsleep = false\n" + solver + "\n" + parts, "test.toml");
  return std::make_unique<World>(scene);
}

inline void Steps(World* world, int ticks) {
  for (int i = 0; i < ticks; ++i) world->Step();
}

/// Formats a number with enough digits for a float.
inline std::string FloatDigits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

}  // namespace seam
