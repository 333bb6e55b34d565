#pragma once
/// Age of displayed poses: the delay at which the oracle's path fits best.

#include <vector>

#include "common/measure/screen/path.h"

namespace seam {

/// Greatest age that is searched for, s.
constexpr double kAgeMax = 1;
/// Length of the spans; each has one age, s.
constexpr double kAgeSpan = 0.5;
/// Least mean speed of a body for a reliable age, m/s.
constexpr double kAgeSpeedMin = 0.1;
/// Greatest RMS misfit for a reliable age, as a share of the oracle's path length in the span.
constexpr double kAgeMisfitMax = 0.1;

/// The age of one body's displayed poses in one span.
struct ViewAge {
  double ticks = 0;   ///< 0..kAgeMax
  double way = 0;     ///< m, path length of the oracle's body; turns count at its radius
  bool told = false;  ///< true if the age is reliable: the body moves and its poses fit the path
};

/// Finds the age, between 0 and kAgeMax, with the least sum of squared differences between the
/// displayed poses of the ticks `first` to `last` and the oracle's that much earlier. The oracle is
/// interpolated linearly between ticks; of equally good ages the least is returned. `radius`: the
/// body's, m.
ViewAge FitAge(const BodyPath& shown, const BodyPath& truth, double radius, std::int64_t first,
               std::int64_t last, int tick_hz);

/// The ages of one body in one peer's views, for each span since shown.first().
class ViewAges {
 public:
  /// Calls FitAge for each span.
  ViewAges(const BodyPath& shown, const BodyPath& truth, double radius, int tick_hz);

  /// Requires a tick of `shown`.
  const ViewAge& SpanOf(std::int64_t tick) const;
  double TicksAt(std::int64_t tick) const { return SpanOf(tick).ticks; }
  /// Returns the first tick that the views can show: they have nothing of before they began.
  double begin() const { return begin_; }

 private:
  std::int64_t first_, length_;
  double begin_;
  std::vector<ViewAge> spans_;
};

}  // namespace seam
