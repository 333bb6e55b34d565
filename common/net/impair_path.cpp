#include "common/net/impair_path.h"

#include <algorithm>

namespace seam {
namespace {

/// IPv4 and UDP headers, which count at a bottleneck too, bytes.
constexpr std::size_t kHeaderBytes = 28;
/// Smallest mean lag of a duplicate, us: a copy in the same microsecond would test nothing.
constexpr double kDuplicateLagUs = 1000;
/// Silence after which stalls are drawn from the present on instead of one by one, us. A Poisson
/// process has no memory, so that only the cost changes.
constexpr std::int64_t kSilenceUs = 100'000'000;

std::int64_t ToUs(double us) { return static_cast<std::int64_t>(us); }

}  // namespace

Stalls::Stalls(double per_s, std::int64_t min_us, std::int64_t max_us, Random random)
    : per_s_(per_s), min_us_(min_us), max_us_(max_us), random_(random) {}

void Stalls::Draw(std::int64_t after_us) {
  begin_us_ = after_us + ToUs(random_.Exponential(1e6 / per_s_));
  const double length = random_.Uniform(static_cast<double>(min_us_), static_cast<double>(max_us_));
  end_us_ = begin_us_ + std::max<std::int64_t>(1, ToUs(length));
}

std::int64_t Stalls::Delay(std::int64_t at_us) {
  if (per_s_ <= 0) return at_us;
  if (!started_ || at_us - end_us_ > kSilenceUs) Draw(at_us);
  started_ = true;
  while (end_us_ <= at_us) Draw(end_us_);
  return at_us >= begin_us_ ? end_us_ : at_us;
}

ImpairPath::ImpairPath(const ImpairProfile& profile, const Random& random)
    : profile_(profile),
      jitter_(random.Fork(1)),
      reorder_(random.Fork(2)),
      duplicate_(random.Fork(3)),
      corrupt_(random.Fork(4)),
      loss_(random.Fork(5)),
      outage_(random.Fork(6)),
      outage_length_(random.Fork(7)),
      spikes_(profile.spikes_per_s, profile.spike_min_us, profile.spike_max_us, random.Fork(8)),
      stalls_(profile.stalls_per_s, profile.stall_min_us, profile.stall_max_us, random.Fork(9)) {}

std::int64_t ImpairPath::Depart(std::int64_t now_us, std::size_t bytes) {
  if (profile_.rate_bits_per_s <= 0) return now_us;
  if (link_free_us_ - now_us > ImpairedNet::kBacklogUsMax) return -1;
  const auto bits = static_cast<std::int64_t>((bytes + kHeaderBytes) * 8);
  link_free_us_ = std::max(link_free_us_, now_us) + bits * 1'000'000 / profile_.rate_bits_per_s;
  return link_free_us_;
}

bool ImpairPath::InOutage(std::int64_t now_us) {
  if (profile_.outage_period_us <= 0) return false;
  const std::int64_t number = now_us / profile_.outage_period_us;
  if (number != outage_number_) {
    // Drawn from the period's number, so that periods without traffic change nothing.
    Random random = outage_length_.Fork(static_cast<std::uint64_t>(number));
    outage_us_ = ToUs(random.Uniform(static_cast<double>(profile_.outage_min_us),
                                     static_cast<double>(profile_.outage_max_us)));
    outage_number_ = number;
  }
  return (number + 1) * profile_.outage_period_us - now_us <= outage_us_;
}

bool ImpairPath::Lost(std::int64_t now_us) {
  bad_ = bad_ ? !loss_.Chance(profile_.loss_bad_to_good) : loss_.Chance(profile_.loss_good_to_bad);
  const bool lost = loss_.Chance(bad_ ? profile_.loss_in_bad : profile_.loss_in_good);
  const bool gone = InOutage(now_us) && outage_.Chance(profile_.outage_loss);
  return lost || gone;
}

void ImpairPath::Arrive(Fate& fate, std::int64_t due_us, std::int64_t now_us, std::size_t bytes) {
  Arrival arrival{due_us, -1};
  if (profile_.corrupt > 0 && corrupt_.Chance(profile_.corrupt)) {
    arrival.flip_bit = static_cast<std::int64_t>(corrupt_.Next() % (bytes * 8));
  }
  if (!Lost(now_us)) fate.arrivals[fate.count++] = arrival;
}

Fate ImpairPath::Next(std::int64_t now_us, std::size_t bytes) {
  Fate fate;
  const std::int64_t departed_us = Depart(now_us, bytes);
  if (departed_us < 0) return fate;
  std::int64_t due_us = departed_us + profile_.delay_us;
  const auto jitter_mean_us = static_cast<double>(profile_.jitter_mean_us);
  if (profile_.jitter_mean_us > 0) due_us += ToUs(jitter_.Exponential(jitter_mean_us));
  due_us = stalls_.Delay(spikes_.Delay(due_us));
  due_us = last_due_us_ = std::max(last_due_us_, due_us);
  if (profile_.reorder > 0 && reorder_.Chance(profile_.reorder)) due_us += profile_.reorder_us;
  Arrive(fate, due_us, now_us, bytes);
  if (profile_.duplicate > 0 && duplicate_.Chance(profile_.duplicate)) {
    const double lag_us = std::max(kDuplicateLagUs, jitter_mean_us);
    Arrive(fate, due_us + ToUs(duplicate_.Exponential(lag_us)), now_us, bytes);
  }
  return fate;
}

}  // namespace seam
