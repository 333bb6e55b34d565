#pragma once
/// How much a session may send: what a client of the room can need, and a margin. What is beyond
/// is dropped before any of it is decoded.

#include <cstddef>
#include <cstdint>

namespace seam {

/// Per second.
struct TrafficRate {
  double bytes = 0;     ///< of datagrams, their headers included
  double messages = 0;  ///< in them, and the datagrams themselves: none is free
};

/// What an honest client of a room sends at most; see the constants in the .cpp for the sum.
TrafficRate HonestTraffic(int tick_hz, int send_hz);
/// What it may send: kBudgetMargin times that.
TrafficRate AllowedTraffic(int tick_hz, int send_hz);
/// A client may be this much better than what we think of, a path may hold back as many seconds of
/// its traffic and let them go at once.
constexpr double kBudgetMargin = 4;
/// What may come at once: this many seconds of the allowed rate (so four of the honest one).
constexpr double kBudgetBurst = 1;
/// A session that has been beyond its budget for so long, us, without a pause of kBudgetCalmUs, has
/// to leave.
constexpr std::int64_t kOverBudgetUs = 10000000;
constexpr std::int64_t kBudgetCalmUs = 1000000;

/// Two token buckets.
class TrafficBudget {
 public:
  explicit TrafficBudget(const TrafficRate& allowed);

  /// Takes one datagram of so many bytes and messages out of the budget; false, and nothing taken,
  /// when there is not enough left of either.
  bool Take(std::int64_t now_us, std::size_t bytes, std::size_t messages);
  /// For how long it has been beyond the budget without a pause, us; 0: it is not.
  std::int64_t over_us(std::int64_t now_us) const;

 private:
  TrafficRate allowed_, left_;
  std::int64_t filled_us_ = -1;
  std::int64_t over_since_us_ = -1, refused_us_ = -1;  // -1: never
};

}  // namespace seam
