#pragma once
/// Grouping: parts at rest against each other become one body until a disturbance.

namespace seam {

struct Grouping {
  float after = 0;         ///< s at rest before grouping; 0: no grouping
  float impact = 0.5f;     ///< m/s; a larger change of the group's velocity in a tick undoes it
  float acceleration = 3;  ///< m/s^2; a larger acceleration of the group undoes it
  float spin = 0.5f;       ///< rad/s; a larger spin of the group undoes it
};

}  // namespace seam
