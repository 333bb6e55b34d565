#pragma once
/// Worlds from a few lines of scene text, for tests.

#include <cmath>
#include <memory>
#include <string>

#include "common/physics/world.h"

namespace seam {

/// `solver` are lines of [solver]; `parts` the rest of the scene. No sleeping: nothing stops by
/// rounding itself to rest.
inline std::unique_ptr<World> SmallWorld(const std::string& parts, const std::string& solver = "",
                                         const std::string& top = "") {
  const Scene scene =
      ParseScene(top + "\n[solver]\nsleep = false\n" + solver + "\n" + parts, "test.toml");
  return std::make_unique<World>(scene);
}

inline void Steps(World* world, int ticks) {
  for (int i = 0; i < ticks; ++i) world->Step();
}

/// Enough digits for a float.
inline std::string FloatDigits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

}  // namespace seam
