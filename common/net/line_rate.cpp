#include "common/net/line_rate.h"

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

constexpr std::int64_t kEpochUs = 10'000'000;
/// Round trips in a look, at least: the least of fewer is no measure of the queue.
constexpr int kRoundTrips = 8;
/// Share of the rate in use from which on it is tested: a rate that is not used proves nothing.
constexpr double kUsed = 0.5;
/// Part of its usual share that arrives on a path that is not full, at least.
constexpr double kArrives = 0.9;
/// Weight of one look in the usual share, and the least share: some of it arrives on any path.
constexpr double kLookWeight = 0.2, kArrivesLeast = 0.2;
/// Rate after a cut, as shares of the arriving bytes: for a queue, and for a deep one.
constexpr double kCutShare = 0.8, kCutDeepShare = 0.5;
/// Growth in a second: up to the rate that was too much, about it, and beyond, where it rises by a
/// factor in each second (as CUBIC, RFC 9438).
constexpr double kGrowthBelow = 0.25, kGrowthAbout = 0.06, kGrowthRise = 2.5, kGrowthMost = 5;
/// Decrease in a second while a queue begins.
constexpr double kEased = 0.5;
constexpr double kAboutFrom = 0.9, kAboutTo = 1.1;
/// Cuts after which the queue must have become shorter.
constexpr int kCutsMost = 6;
/// Silence after which the rate is halved, us: nothing arrives.
constexpr std::int64_t kUnheardUs = 1'000'000;

}  // namespace

std::int64_t LineRate::NoteSent(std::int64_t now_us, std::size_t bytes) {
  if (looked_us_ < 0) looked_us_ = begun_us_ = now_us;
  sent_ += static_cast<double>(bytes);
  total_ += static_cast<std::int64_t>(bytes);
  const std::int64_t silent_us = now_us - std::max({looked_us_, heard_us_, halved_us_});
  const bool used = sent_ > kUsed * rate_ * static_cast<double>(kUnheardUs) * 1e-6;
  if (silent_us >= kUnheardUs && used) {
    halved_us_ = now_us;
    rate_ = std::max(kLeast, rate_ / 2);
  }
  return total_;
}

void LineRate::NoteRoundTrip(std::int64_t now_us, std::int64_t rtt_us, std::int64_t total) {
  if (now_us - epoch_us_ >= kEpochUs) {
    epoch_us_ = now_us;
    least_before_us_ = least_us_;
    least_us_ = -1;
  }
  least_us_ = least_us_ < 0 ? rtt_us : std::min(least_us_, rtt_us);
  rtt_least_us_ = rtts_ == 0 ? rtt_us : std::min(rtt_least_us_, rtt_us);
  rtt_sum_us_ += rtt_us;
  ++rtts_;
  newest_ = std::max(newest_, total);
  if (rtts_ >= kRoundTrips && now_us - looked_us_ >= std::max(kRateLookUs, least_us_)) Look(now_us);
}

void LineRate::Look(std::int64_t now_us) {
  const double passed_s = static_cast<double>(now_us - begun_us_) * 1e-6;
  const double sent = sent_ / passed_s;
  const auto due = static_cast<double>(newest_ - newest_looked_);  // would be here without losses
  const bool used = sent > kUsed * rate_;
  if (!used && due > 0) {
    const double share = std::clamp(arrived_ / due, kArrivesLeast, 1.0);
    arrives_ += kLookWeight * (share - arrives_);
  }
  const double arriving = arrived_ / passed_s / arrives_;  // without the usual losses
  const std::int64_t least =
      least_before_us_ < 0 ? least_us_ : std::min(least_us_, least_before_us_);
  // The mean of a look is above its least by the jitter, and while a queue builds up.
  const std::int64_t jitter_us = 2 * (rtt_sum_us_ / rtts_ - rtt_least_us_);
  queue_us_ = rtt_least_us_ - least;
  // Time that a datagram takes on a thin line by itself, and that a peer waits to acknowledge it.
  const std::int64_t apart_us = (now_us - begun_us_) / std::max(1, datagrams_);
  const bool lacks = arrived_ < kArrives * arrives_ * due;
  looked_us_ = begun_us_ = now_us;
  newest_looked_ = newest_;
  sent_ = arrived_ = 0;
  datagrams_ = 0;
  rtts_ = rtt_sum_us_ = 0;
  const std::int64_t least_queue_us = kQueueUs + std::max(jitter_us, apart_us);
  const bool deep = queue_us_ > 2 * kQueueUs + least_queue_us;
  if (deep || (queue_us_ > least_queue_us && (used || lacks))) return Cut(arriving, deep);
  cuts_ = 0;
  if (!used) return;
  if (lacks) {
    rate_ = std::clamp(kArrivingShare * arriving, kLeast, rate_);
    return;
  }
  if (full_ > 0 && queue_us_ > std::max(kQueueUs, apart_us)) {  // it begins to fill
    rate_ = std::max(kLeast, rate_ * (1 - kEased * passed_s));
    return;
  }
  if (rate_ < kAboutFrom * full_) {
    growth_ = kGrowthBelow;
  } else if (rate_ < kAboutTo * full_) {
    growth_ = kGrowthAbout;
  } else {
    growth_ = std::min(growth_ * std::pow(kGrowthRise, passed_s), kGrowthMost);
  }
  rate_ = std::min(kFastest, rate_ * (1 + growth_ * passed_s));
}

void LineRate::Cut(double arriving, bool deep) {
  if (cuts_++ == 0) cut_queue_us_ = queue_us_;
  const double share = deep ? kCutDeepShare : kCutShare;
  rate_ = std::clamp(share * arriving, kLeast, rate_);
  // The path carries the rest while the queue drains; until then it shows nothing new.
  looked_us_ += static_cast<std::int64_t>(static_cast<double>(queue_us_) / (1 - share));
  full_ = arriving;
  if (cuts_ < kCutsMost) return;
  // The path itself has become longer, or others fill it: the present round trip is the least.
  if (queue_us_ > cut_queue_us_ * 3 / 4) {
    least_us_ = rtt_least_us_;
    least_before_us_ = -1;
    full_ = 0;
  }
  cuts_ = 0;
}

}  // namespace seam
