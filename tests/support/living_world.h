#pragma once
/// A world that applies the edits that it proposes, like an oracle.

#include <vector>

#include "tests/support/small_world.h"

namespace seam {

/// Steps, and applies the edits that each step proposes. Returns all of them.
inline std::vector<Edit> Live(World* world, int ticks) {
  std::vector<Edit> all;
  for (int i = 0; i < ticks; ++i) {
    world->Step();
    const std::vector<Edit> edits = world->ProposeEdits();
    if (!edits.empty()) world->Apply(edits);
    all.insert(all.end(), edits.begin(), edits.end());
  }
  return all;
}

}  // namespace seam
