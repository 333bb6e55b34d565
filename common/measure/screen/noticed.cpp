#include "common/measure/screen/noticed.h"

#include <algorithm>

#include "common/measure/screen/thresholds.h"

namespace seam {

std::optional<double> BodySeconds::Share() const {
  if (moved_.empty()) return std::nullopt;
  std::int64_t both = 0;
  for (const Key& key : moved_) both += noticed_.count(key) > 0 ? 1 : 0;
  return static_cast<double>(both) / static_cast<double>(moved_.size());
}

std::optional<Place3> ShownBody::TrueWay(std::int64_t from, std::int64_t to,
                                         std::int64_t aged) const {
  const double age = ages.TicksAt(aged), begin = ages.begin();
  const double a = std::max(begin, static_cast<double>(from) - age);
  const double b = std::max(begin, static_cast<double>(to) - age);
  if (!truth.Whole(a, b)) return std::nullopt;
  return Between(truth.At(a), truth.At(b), radius);
}

std::vector<std::int64_t> MovingTicks(const ShownBody& body) {
  std::vector<std::int64_t> ticks;
  const double step_min = kMovesMin * body.h;
  for (std::int64_t tick = body.shown.first() + 1; tick <= body.shown.last(); ++tick) {
    const auto moves = [&](const BodyPath& path) {
      return path.Whole(tick - 1, tick) &&
             Between(path.At(tick - 1), path.At(tick), body.radius).norm() >= step_min;
    };
    if (body.shown.Has(tick) && (moves(body.shown) || moves(body.truth))) ticks.push_back(tick);
  }
  return ticks;
}

}  // namespace seam
