#include "common/measure/screen/age.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/base/check.h"

namespace seam {
namespace {

/// The sum of squares at the best age between `age` and `age + 1` ticks.
struct Trial {
  double sum = std::numeric_limits<double>::infinity();
  double ticks = 0;
  double way = 0;  // m, of one tick, summed over the samples
};

/// Fits by linear least squares: between two ticks the oracle is A + f B with 0 <= f <= 1. Before
/// its first tick the oracle has the pose of that tick. nullopt where the oracle is not known.
std::optional<Trial> Try(const BodyPath& shown, const BodyPath& truth, double radius,
                         const std::vector<std::int64_t>& ticks, std::int64_t age) {
  double dd = 0, db = 0, bb = 0, way = 0;
  for (const std::int64_t tick : ticks) {
    const std::int64_t begin = std::max(truth.first(), shown.first_known());
    const std::int64_t at = std::max(tick - age, begin);
    if (!truth.Has(at)) return std::nullopt;
    const DoublePose& now = truth.At(at);
    const Place3 d = Between(now, shown.At(tick), radius);
    const bool further = truth.Has(at - 1) && at == tick - age && at > begin;
    const Place3 b = Between(now, further ? truth.At(at - 1) : now, radius);
    dd += d.squaredNorm();
    db += d.dot(b);
    bb += b.squaredNorm();
    way += b.norm();
  }
  const double f = bb > 0 ? std::clamp(db / bb, 0.0, 1.0) : 0;
  return Trial{std::max(0.0, dd - 2 * f * db + f * f * bb), static_cast<double>(age) + f, way};
}

}  // namespace

ViewAges::ViewAges(const BodyPath& shown, const BodyPath& truth, double radius, int tick_hz)
    : first_(shown.first()),
      length_(std::max<std::int64_t>(1, std::llround(kAgeSpan * tick_hz))),
      begin_(static_cast<double>(std::max(truth.first(), shown.first_known()))) {
  for (std::int64_t first = first_; first <= shown.last(); first += length_) {
    const std::int64_t last = std::min(first + length_ - 1, shown.last());
    spans_.push_back(FitAge(shown, truth, radius, first, last, tick_hz));
  }
  // Any age fits a body that stands: it keeps the age that it had when it moved.
  std::optional<double> known;
  for (ViewAge& age : spans_) {
    if (age.way * tick_hz >= kAgeSpeedMin * static_cast<double>(length_)) {
      known = age.ticks;
    } else if (known) {
      age.ticks = *known;
    }
  }
}

ViewAge FitAge(const BodyPath& shown, const BodyPath& truth, double radius, std::int64_t first,
               std::int64_t last, int tick_hz) {
  std::vector<std::int64_t> ticks;
  for (std::int64_t tick = first; tick <= last; ++tick) {
    if (shown.Has(tick) && truth.Has(tick)) ticks.push_back(tick);
  }
  if (ticks.empty()) return {};
  const std::int64_t age_max = std::llround(kAgeMax * tick_hz);
  Trial best;
  for (std::int64_t age = 0; age < age_max; ++age) {
    const std::optional<Trial> trial = Try(shown, truth, radius, ticks, age);
    if (!trial) break;
    if (trial->sum < best.sum) best = *trial;
    if (best.sum == 0) break;
  }
  ViewAge found;
  if (!std::isfinite(best.sum)) return found;
  const auto count = static_cast<double>(ticks.size());
  found.ticks = best.ticks;
  found.way = best.way;
  found.told = found.way * tick_hz >= kAgeSpeedMin * count &&
               std::sqrt(best.sum / count) <= kAgeMisfitMax * found.way;
  return found;
}

const ViewAge& ViewAges::SpanOf(std::int64_t tick) const {
  const auto span = static_cast<std::size_t>((tick - first_) / length_);
  SEAM_ASSERT(tick >= first_ && span < spans_.size());
  return spans_[span];
}

}  // namespace seam
