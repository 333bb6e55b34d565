#pragma once
/// Whose view glides gently: everybody looks at who is on the way to a seat, or just out of one,
/// and whoever hears of that late has metres to catch up.

#include <vector>

#include "common/physics/world.h"

namespace seam {

class SeatGlide {
 public:
  /// To be called once a tick.
  void Look(const World& world);
  /// Whether a mechanism is one of them.
  bool IsGentle(int mechanism) const;

 private:
  std::vector<int> ticks_;   // by player: for how much longer
  std::vector<int> gentle_;  // mechanisms
};

}  // namespace seam
