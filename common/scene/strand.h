#pragma once
/// A strand: hair, a scarf, a flag's tail that hangs on a part. Purely visual: each peer simulates
/// it for its own view; it exerts no force and is never sent over the network.

#include <string>

#include "common/scene/types.h"

namespace seam {

struct Strand {
  std::string name;        ///< unique
  PartId part = 0;         ///< part that it hangs on
  Vec2 at{0, 0};           ///< m, in the part's frame
  float length = 1;        ///< m
  int links = 8;           ///< number of segments
  float width = 0.05f;     ///< m, as drawn at the root; it tapers to a point
  float stiffness = 0.1f;  ///< 0: a thread .. 1: a twig
  float damping = 1;       ///< 1/s, of its motion through the air
  int line = 0;            ///< line in the scene file
};

}  // namespace seam
