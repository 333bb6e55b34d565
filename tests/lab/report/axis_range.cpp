#include <algorithm>
#include <cmath>

#include "tests/lab/report/figure.h"

namespace seam {

PlotRange FindRange(const std::vector<double>& values, bool log) {
  PlotRange range;
  bool any = false;
  for (const double v : values) {
    if (!std::isfinite(v)) {
      range.infinity = true;
    } else if (log && v <= 0) {
      range.zero = true;
    } else {
      range.low = any ? std::min(range.low, v) : v;
      range.high = any ? std::max(range.high, v) : v;
      any = true;
    }
  }
  if (log) {
    if (!any) range.low = 1, range.high = 10;
    // A span below 1.6 times would be drawn as if small differences were large.
    const double widen = std::max(0.0, 0.2 - std::log10(range.high / range.low));
    range.low /= std::pow(10, widen / 2);
    range.high *= std::pow(10, widen / 2);
    const double margin = std::pow(range.high / range.low, 0.06);
    if (range.zero) {
      range.zero_at = range.low / margin / margin;
      range.low = range.zero_at;
    }
    if (range.infinity) {
      range.infinity_at = range.high * margin * margin;
      range.high = range.infinity_at;
    }
    range.low /= margin;
    range.high *= margin;
  } else {
    if (!any) range.low = 0, range.high = 1;
    range.low = std::min(range.low, 0.0);
    if (range.high <= range.low) range.high = range.low + 1;
    const double margin = 0.05 * (range.high - range.low);
    if (range.infinity) {
      range.infinity_at = range.high + 2 * margin;
      range.high = range.infinity_at;
    }
    if (range.low < 0) range.low -= margin;
    range.high += margin;
  }
  return range;
}

double PlaceOn(const PlotRange& range, double value, bool log) {
  if (!std::isfinite(value)) return range.infinity_at;
  return log && value <= 0 ? range.zero_at : value;
}

std::vector<double> LogTics(const PlotRange& range) {
  const double low = range.zero ? range.zero_at * 1.6 : range.low;
  const double high = range.infinity ? range.infinity_at / 1.6 : range.high;
  const double decades = std::log10(high / low);
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 9)));
  std::vector<double> tics;
  std::vector<double> steps = {1};
  if (decades < 2.5) steps = {1, 2, 5};
  if (decades < 1.2) steps = {1, 2, 3, 4, 5, 7};
  if (decades < 0.5) steps = {1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 9};
  for (int power = first; power <= last; ++power) {
    if (power % every != 0) continue;
    for (const double step : steps) {
      const double tic = step * std::pow(10, power);
      if (tic >= low && tic <= high) tics.push_back(tic);
    }
  }
  return tics;
}

PlotRanges RangesOf(const PlotPanel& panel) {
  std::vector<double> xs, ys;
  for (const PlotCurve& curve : panel.curves) {
    for (const PlotPoint& point : curve.points) {
      xs.push_back(point.x);
      for (const double y : {point.y, point.low, point.high}) ys.push_back(y);
    }
  }
  for (const Level& level : panel.levels) ys.push_back(level.y);
  for (const Level& upright : panel.uprights) xs.push_back(upright.y);
  return {FindRange(xs, panel.x.log), FindRange(ys, panel.y.log)};
}

}  // namespace seam
