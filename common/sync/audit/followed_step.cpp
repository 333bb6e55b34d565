#include "common/sync/audit/followed_step.h"

#include <algorithm>
#include <utility>

namespace seam {
namespace {

/// A part that goes elsewhere by more than this, m/s, may be the wrong foot: it steps by 2 to 4,
/// the other one stands. The same foot: up to .4.
constexpr double kOtherFoot = 1;

}  // namespace

bool FollowedStep::Add(std::int64_t tick, std::int64_t rest, const std::optional<Gain>& gain) {
  const double apart = gain && gain->seconds > 0 ? gain->apart / gain->seconds : 0;
  const double tried = std::exchange(tried_, -1);
  if (tried >= 0) return !gain || apart > tried / 2;  // an interval in vain: back
  if (!gain) {
    unknown_ = true;
    return false;
  }
  if (!sum_) sum_.emplace();
  sum_->seconds += gain->seconds;
  sum_->position += gain->position;
  sum_->velocity += gain->velocity;
  sum_->stepped = gain->stepped;
  sum_->apart = std::max(sum_->apart, gain->apart);
  sum_->met = sum_->met || gain->met;
  if (apart < kOtherFoot || gain->met || tick < next_trial_) return false;
  tried_ = apart;
  next_trial_ = tick + rest;
  return true;
}

std::optional<Gain> FollowedStep::Take() {
  const std::optional<Gain> sum = std::exchange(sum_, std::nullopt);
  return std::exchange(unknown_, false) ? std::nullopt : sum;
}

}  // namespace seam
