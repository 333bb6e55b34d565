#pragma once
/// Parts at rest against each other that become one body until something disturbs them.

namespace seam {

struct Grouping {
  float after = 0;         ///< s at rest against each other; 0: nothing is grouped
  float impact = 0.5f;     ///< m/s, change of velocity of the whole within a tick that undoes it
  float acceleration = 3;  ///< m/s^2, of the whole, above which it is undone
  float spin = 0.5f;       ///< rad/s, of the whole, likewise
};

}  // namespace seam
