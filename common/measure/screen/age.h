#pragma once
/// Which tick a displayed pose shows: the age at which the oracle's path fits best.

#include <vector>

#include "common/measure/screen/path.h"

namespace seam {

/// The oldest that is looked for, s.
constexpr double kAgeMax = 1;
/// One age is found for each span of this length, s.
constexpr double kAgeSpan = 0.5;
/// A body that is slower on average tells no age, m/s.
constexpr double kAgeSpeedMin = 0.1;
/// Nor does one that is off the oracle's path by more than this share of the way in the span.
constexpr double kAgeMisfitMax = 0.1;

/// The age of what is shown of one body in one span.
struct ViewAge {
  double ticks = 0;   ///< 0..kAgeMax
  double way = 0;     ///< m that the oracle's body goes in the span; a turn counts at its radius
  bool told = false;  ///< it moves, and what is shown is on its path: the age means something
};

/// The age, between 0 and kAgeMax, with the least sum of squares of what is shown in the ticks from
/// `first` to `last` against the oracle that much earlier, which moves on straight lines between
/// its ticks; the least of equal ones. `radius`: the body's, m.
ViewAge FitAge(const BodyPath& shown, const BodyPath& truth, double radius, std::int64_t first,
               std::int64_t last, int tick_hz);

/// The ages of what a peer shows of one body: of the spans since shown.first().
class ViewAges {
 public:
  /// FitAge of each span.
  ViewAges(const BodyPath& shown, const BodyPath& truth, double radius, int tick_hz);

  /// Requires a tick of `shown`.
  const ViewAge& SpanOf(std::int64_t tick) const;
  double TicksAt(std::int64_t tick) const { return SpanOf(tick).ticks; }

 private:
  std::int64_t first_, length_;
  std::vector<ViewAge> spans_;
};

}  // namespace seam
