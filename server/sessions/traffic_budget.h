#pragma once
/// Limits the traffic from a session to the most that an honest client sends, times a margin.
/// Datagrams beyond the limit are dropped before they are decoded.

#include <cstddef>
#include <cstdint>

#include "common/base/bytes.h"

namespace seam {

/// Per second.
struct TrafficRate {
  double bytes = 0;     ///< datagram bytes, headers included
  double messages = 0;  ///< messages, plus one for each datagram: an empty one is not free
};

/// Returns the most that an honest client of a room sends; see the constants in the .cpp.
TrafficRate HonestTraffic(int tick_hz, int send_hz);
/// Returns the limit: kBudgetMargin times HonestTraffic.
TrafficRate AllowedTraffic(int tick_hz, int send_hz);
/// Allowed rate divided by honest rate. A client may send more than we expect by this factor; or a
/// path may hold back as many seconds of its traffic and release them at once.
constexpr double kBudgetMargin = 4;
/// Largest burst: this many seconds of the allowed rate (so four of the honest one).
constexpr double kBudgetBurst = 1;
/// A session beyond its budget for this long, us, without a pause of kBudgetCalmUs, has to leave.
constexpr std::int64_t kOverBudgetUs = 10000000;
constexpr std::int64_t kBudgetCalmUs = 1000000;

/// Two token buckets: bytes and messages.
class TrafficBudget {
 public:
  explicit TrafficBudget(const TrafficRate& allowed);

  /// Takes one datagram of so many bytes and messages out of the budget. Returns false, and takes
  /// nothing, if either is not enough.
  bool Take(std::int64_t now_us, std::size_t bytes, std::size_t messages);
  /// Returns for how long the session has been beyond its budget without a pause, us; 0: within it.
  std::int64_t over_us(std::int64_t now_us) const;

 private:
  TrafficRate allowed_, left_;
  std::int64_t filled_us_ = -1;
  std::int64_t over_since_us_ = -1, refused_us_ = -1;  // -1: never
};

/// Limits messages by their type, before they are decoded: states, proposals, impact and touch
/// reports. One token bucket each; other types are not limited here.
class KindBudget {
 public:
  /// `send_hz`: of the room; `parts`: of its scene.
  explicit KindBudget(int send_hz = 30, std::size_t parts = 0);

  /// Takes a message out of its type's budget. Returns false, and takes nothing, if it is used up.
  bool Take(std::int64_t now_us, ByteView message);

 private:
  struct Bucket {
    double per_second = 0, most = 0, left = 0;
    std::int64_t filled_us = -1;
  };
  Bucket* BucketOf(ByteView message);

  Bucket states_, proposals_, reports_;
};

}  // namespace seam
