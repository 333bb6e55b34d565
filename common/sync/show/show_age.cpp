#include "common/sync/show/show_age.h"

#include <algorithm>

namespace seam {

double ShowAge::Glide(double moment, double now, double due, double speed) {
  // A body that stands may be shown at any moment; its age rises while its moment stands.
  const double rate = speed > kUnseenSpeed ? std::max(kUnseenSpeed / speed, kUnseenShare) : 1;
  return std::clamp(now - due, moment + 1 - rate, moment + 1 + rate);
}

std::int64_t ShowAge::Unknown(int player, std::int64_t missing) {
  const auto index = static_cast<std::size_t>(player);
  if (heard_.size() <= index) heard_.resize(index + 1);
  Heard& heard = heard_[index];
  const bool came = heard.look == look_ - 1 && missing <= heard.missing;
  if (came) heard.late.Add(missing);
  heard.look = look_;
  heard.missing = missing;
  if (heard.late.empty()) return missing;
  const std::int64_t late = heard.late.Most() + 1;
  const auto silence = static_cast<std::int64_t>(kUsualSilenceS * config_.tick_hz);
  return missing <= late + silence ? std::min(missing, late) : missing;
}

void ShowAge::Look(const MissingInputs& missing) {
  ++look_;
  std::int64_t unknown = 0;
  for (const auto& [player, ticks] : missing) unknown = std::max(unknown, Unknown(player, ticks));
  if (unknown_.empty()) unknown_.Fill(config_.show_age_ticks);
  unknown_.Add(unknown);
  due_ = static_cast<double>(std::min<std::int64_t>(unknown_.Most(), config_.show_age_ticks));
}

}  // namespace seam
