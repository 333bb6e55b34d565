#pragma once
/// Connectors: positions at which parts join, an outlet of one part with an inlet of another.

#include <vector>

#include "common/scene/types.h"

namespace seam {

struct Connector {
  Vec2 at{0, 0};    ///< m, in the part's frame
  float angle = 0;  ///< rad; outward direction
};

/// An inlet takes one outlet. Once joined, the two share one position and face each other.
struct Connectors {
  std::vector<Connector> inlets, outlets;
  float strength = 0;  ///< N, breaking force; 0: unbreakable. The weaker part's counts
  float reach = 0.1f;  ///< m; they join when closer. The shorter part's counts
  float angle = 0.3f;  ///< rad; largest misalignment at which they join

  bool empty() const { return inlets.empty() && outlets.empty(); }
};

/// Least closing speed of parts that join, m/s: slower ones do not, otherwise a cracked bond would
/// join again at once.
constexpr float kJoinClosing = 0.1f;

/// Least time between a break and the next join of the same parts, s: otherwise parts torn apart
/// would join again before they have separated.
constexpr float kJoinAgain = 1;

}  // namespace seam
