#include "common/sync/show/show_age.h"

#include <algorithm>

namespace seam {

double ShowAge::Glide(double moment, double now, double due, double speed) {
  // A body that stands may be shown at any moment; its age rises while its moment stands.
  const double rate = speed > kUnseenSpeed ? std::max(kUnseenSpeed / speed, kUnseenShare) : 1;
  return std::clamp(now - due, moment + 1 - rate, moment + 1 + rate);
}

void ShowAge::Look(std::int64_t missing) {
  if (missing_.empty()) missing_.Fill(config_.show_age_ticks);
  missing_.Add(missing);
  due_ = static_cast<double>(std::min<std::int64_t>(missing_.Most(), config_.show_age_ticks));
}

}  // namespace seam
