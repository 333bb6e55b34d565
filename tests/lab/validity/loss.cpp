#include "tests/lab/validity/loss.h"

namespace seam {
namespace {

/// Of the loss that the profile says, what must have been measured.
constexpr double kLossShareMin = 0.9;
/// Standard deviations by which chance may stay below that.
constexpr double kLossDeviations = 3;

}  // namespace

bool LossTooSmall(const ImpairProfile& profile, const ImpairedTraffic& traffic) {
  const double due = kLossShareMin * MeanLoss(profile) * static_cast<double>(traffic.offered);
  const double chance = kLossDeviations * LossDeviation(profile, traffic.offered);
  return static_cast<double>(traffic.lost) < due - chance;
}

}  // namespace seam
