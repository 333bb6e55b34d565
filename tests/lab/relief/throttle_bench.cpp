/// A client throttled to a quarter, beside its bars.

#include <fmt/format.h>

#include <algorithm>

#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/relief/throttle.h"

namespace seam {

TextTable ReliefThrottleBench(bool quick) {
  const int seeds = quick ? 1 : 12;
  std::vector<double> loads, ratios;
  double mean = 0, free_most = 0, free_least = 9;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Throttled free = MeasureThrottled(1, seed), slow = MeasureThrottled(4, seed);
    loads.push_back(slow.load);
    free_most = std::max(free_most, free.load);
    free_least = std::min(free_least, free.load);
    for (const double ratio : ErrorRatios(free, slow)) ratios.push_back(ratio);
  }
  std::sort(loads.begin(), loads.end());
  std::sort(ratios.begin(), ratios.end());
  for (const double ratio : ratios) mean += ratio / static_cast<double>(ratios.size());
  std::vector<BarRow> rows = {
      AtMost("a client at a quarter of its speed: the largest load from 5 s on", loads.back(), 1.25,
             "", fmt::format("median {}", Digits(loads[loads.size() / 2]))),
      AtMost("error of each of the others, with it / without: median", ratios[ratios.size() / 2],
             1.2, "", fmt::format("mean {}, largest {}", Digits(mean), Digits(ratios.back())))};
  for (BarRow& row : rows) {
    row.given = fmt::format("not throttled it needs {:.0f} to {:.0f} % of its time (25 to 80)",
                            100 * free_least, 100 * free_most);
    row.valid = free_least > 0.25 && free_most < 0.8;
  }
  return TableOf("throttle", "A slow client", rows,
                 fmt::format("Four players with twelve crates each, bots, 10 s over `demo`; what a "
                             "client needs is {:.0f} µs for each body in each step, four times as "
                             "much for the slow one. {} pairs of sessions.",
                             kThrottleBodyUs, seeds));
}

}  // namespace seam
