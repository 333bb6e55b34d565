#include "common/sync/audit/steady_gain.h"

#include <cmath>

namespace seam {
namespace {

/// Slower than this a mechanism has no direction, m/s.
constexpr double kHasDirection = 0.5;
/// Share of the newest change in the mean square of changes.
constexpr double kNewest = 0.05;

}  // namespace

void SteadyGain::Sums::Add(double x) {
  x = std::clamp(x, -kCountsMost, kCountsMost);
  square += kNewest * ((x - before) * (x - before) / 2 - square);
  before = x;
  AddTo(x, 1 + kShare * std::sqrt(square));
}

void SteadyGain::Sums::AddFine(double x) { AddTo(std::clamp(x, -kFinest, kFinest), 1); }

void SteadyGain::Sums::AddTo(double x, double honest) {
  up = std::clamp(up + x - honest, 0.0, 2 * kLie);
  down = std::clamp(down - x - honest, 0.0, 2 * kLie);
}

void SteadyGain::Add(const Gain& gain) {
  if (gain.seconds <= 0) return;
  const double pushed = gain.met ? kInCompany : 1, slipped = gain.summed ? 1 : pushed;
  const double speed = double{gain.stepped.norm()};
  const Eigen::Vector2d along = speed < kHasDirection
                                    ? Eigen::Vector2d(0, 0)
                                    : Eigen::Vector2d(gain.stepped.cast<double>() / speed);
  const Eigen::Vector2d push = gain.velocity.cast<double>() / (pushed * gain.seconds * kPush);
  const Eigen::Vector2d slip = gain.position.cast<double>() / (slipped * gain.seconds * kSlip);
  const std::array<double, 7> all = {push.dot(along),
                                     push.x(),
                                     push.y(),
                                     slip.dot(along),
                                     slip.x(),
                                     slip.y(),
                                     gain.apart / (slipped * kTorn)};
  gross_ = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    sums_[i].Add(all[i]);
    gross_ = gross_ || std::fabs(all[i]) >= kCountsMost;
  }
  if (gain.summed) AddFine(slip, slip.dot(along));
}

void SteadyGain::AddFine(const Eigen::Vector2d& slip, double along) {
  constexpr double kTimes = kSlip / kFineSlip;
  fine_[0].AddFine(kTimes * along);
  fine_[1].AddFine(kTimes * slip.x());
  fine_[2].AddFine(kTimes * slip.y());
}

void SteadyGain::NoteAllTold(bool all) {
  left_out_ = std::clamp(left_out_ + (all ? 0 : kCountsMost) - 1, 0.0, 2 * kLie);
}

double SteadyGain::share_of_gains() const {
  double most = 0;
  for (const Sums& sums : sums_) most = std::max({most, sums.up, sums.down});
  for (const Sums& sums : fine_) most = std::max({most, sums.up, sums.down});
  return most / kLie;
}

}  // namespace seam
