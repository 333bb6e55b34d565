#pragma once
/// Resting parts that become one body until something touches them.

namespace seam {

struct Grouping {
  float after = 0;      ///< s at rest; 0: nothing is grouped
  float impact = 0.5f;  ///< m/s, change of velocity of the whole that undoes it
};

}  // namespace seam
