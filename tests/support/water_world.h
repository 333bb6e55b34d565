#pragma once
/// A sea whose level is 0, for tests of water.

#include <string>

#include "tests/support/small_world.h"

namespace seam {

/// Makes a sea, 400 m wide and 50 m deep; `more` are lines of its [[water]].
inline std::string Sea(const std::string& more = "") {
  return "[[water]]\nname = \"sea\"\nbox = [400, 50]\nposition = [0, -25]\n" + more + "\n";
}

/// Makes a sea without drag: a floating body bobs for ever.
inline std::string IdealSea(const std::string& more = "") {
  return Sea("viscosity = 0\ndrag_normal = 0\ndrag_tangent = 0\n" + more);
}

inline std::string Floater(const std::string& name, const std::string& rest) {
  return "[[part]]\nname = \"" + name + "\"\n" + rest + "\n";
}

}  // namespace seam
