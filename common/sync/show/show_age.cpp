#include "common/sync/show/show_age.h"

#include <algorithm>

namespace seam {

double ShowAge::Glide(double moment, double now, double due, double speed) {
  // A body that stands may be shown at any moment; its age rises while its moment stands.
  const double rate = speed > kUnseenSpeed ? std::max(kUnseenSpeed / speed, kUnseenShare) : 1;
  return std::clamp(now - due, moment + 1 - rate, moment + 1 + rate);
}

void ShowAge::NoteLate(int player, std::int64_t ticks) {
  const auto index = static_cast<std::size_t>(player);
  if (late_.size() <= index) late_.resize(index + 1);
  late_[index].Add(ticks);
}

void ShowAge::Look(const MissingInputs& missing) {
  std::int64_t unknown = 0;
  for (const auto& [player, ticks] : missing) {
    const auto index = static_cast<std::size_t>(player);
    const bool known = index < late_.size() && !late_[index].empty();
    unknown = std::max(unknown, known ? std::min(ticks, late_[index].Most()) : ticks);
  }
  if (unknown_.empty()) unknown_.Fill(config_.show_age_ticks);
  unknown_.Add(unknown);
  due_ = static_cast<double>(std::min<std::int64_t>(unknown_.Most(), config_.show_age_ticks));
}

}  // namespace seam
