#pragma once
/// Positions by which a part joins others: an outlet of one meets an inlet of another.

#include <vector>

#include "common/scene/types.h"

namespace seam {

struct Connector {
  Vec2 at{0, 0};    ///< m, in the part's frame
  float angle = 0;  ///< rad; the way out of the part
};

/// An inlet takes one outlet. Joined, the two are at one position and face each other.
struct Connectors {
  std::vector<Connector> inlets, outlets;
  float strength = 0;  ///< N that break the joint; 0: none does. The weaker part's
  float reach = 0.1f;  ///< m; closer than this they join. The shorter part's
  float angle = 0.3f;  ///< rad; the most they may be turned away from each other

  bool empty() const { return inlets.empty() && outlets.empty(); }
};

/// Parts that come together more slowly do not join, m/s: otherwise a cracked bond would join again
/// at once.
constexpr float kJoinClosing = 0.1f;

/// Least time between a break and the next joint of the parts concerned, s: else parts torn apart
/// would join again before they are away.
constexpr float kJoinAgain = 1;

}  // namespace seam
