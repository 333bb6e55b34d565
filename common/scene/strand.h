#pragma once
/// Hair, a scarf, a flag's tail: a strand that hangs on a part and is there to be looked at. Each
/// peer simulates it for its own view; nothing feels it, and it never goes over the network.

#include <string>

#include "common/scene/types.h"

namespace seam {

struct Strand {
  std::string name;        ///< unique
  PartId part = 0;         ///< that it hangs on
  Vec2 at{0, 0};           ///< m, in the part's frame
  float length = 1;        ///< m
  int links = 8;           ///< that it bends between
  float width = 0.05f;     ///< m, as drawn at the root; it ends in a point
  float stiffness = 0.1f;  ///< 0: a thread .. 1: a twig
  float damping = 1;       ///< 1/s, of its motion in the air
  int line = 0;            ///< in the scene file
};

}  // namespace seam
