#include "common/sync/show/show_age.h"

#include <algorithm>

namespace seam {

double ShowAge::Glide(double moment, double now, double due) {
  return std::clamp(now - due, moment + 1 - double{kAgeRise}, moment + 1 + double{kAgeFall});
}

void ShowAge::Look(std::int64_t missing) {
  missing_.Add(missing);
  due_ = static_cast<double>(std::min<std::int64_t>(missing_.Most(), config_.show_age_ticks));
}

}  // namespace seam
