#include "common/sync/audit/followed_step.h"

#include <algorithm>
#include <utility>

namespace seam {
namespace {

/// A part that goes elsewhere by more than this, m/s, may be the wrong foot: it steps by 2 to 4,
/// the other one stands. The same foot: up to .4.
constexpr double kElsewhere = 1, kFits = 0.4;

}  // namespace

std::optional<int> FollowedStep::Add(std::int64_t tick, std::int64_t rest,
                                     const std::optional<Gain>& gain) {
  const double apart = gain && gain->seconds > 0 ? gain->apart / gain->seconds : 0;
  if (trial_) {
    if (gain && apart <= std::max(kFits, trial_->apart / 4)) {
      trial_.reset();
      next_trial_ = tick;
      return std::nullopt;
    }
    next_trial_ = tick + rest;
    return ++trial_->other;
  }
  if (!gain) {
    unknown_ = true;
    return std::nullopt;
  }
  if (!sum_) sum_.emplace();
  sum_->summed = true;
  sum_->seconds += gain->seconds;
  sum_->position += gain->position;
  sum_->velocity += gain->velocity;
  sum_->stepped = gain->stepped;
  sum_->apart = std::max(sum_->apart, gain->apart);
  sum_->met = sum_->met || gain->met;
  if (apart < kElsewhere || gain->met || tick < next_trial_) return std::nullopt;
  trial_ = Trial{0, apart};
  next_trial_ = tick + rest;
  return 0;
}

std::optional<Gain> FollowedStep::Take() {
  const std::optional<Gain> sum = std::exchange(sum_, std::nullopt);
  return std::exchange(unknown_, false) ? std::nullopt : sum;
}

}  // namespace seam
