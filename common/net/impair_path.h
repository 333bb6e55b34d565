#pragma once
/// The impairments of one direction of one path: decides for each datagram when and how often it
/// arrives and which bit is flipped. Pure arithmetic on the seed; holds no datagrams.

#include <cstdint>

#include "common/base/random.h"
#include "common/net/impair.h"

namespace seam {

/// One arrival of a datagram.
struct Arrival {
  std::int64_t due_us = 0;
  std::int64_t flip_bit = -1;  ///< index of the flipped bit, -1: none
};

/// The arrivals of one datagram: none, one or two.
struct Fate {
  int count = 0;
  Arrival arrivals[2];
};

/// Stalls of a path: nothing arrives in [begin, end). The begins are a Poisson process.
class Stalls {
 public:
  Stalls(double per_s, std::int64_t min_us, std::int64_t max_us, Random random);
  /// Returns `at_us` or, if that is within a stall, the end of the stall. Successive times must not
  /// decrease by more than the jitter.
  std::int64_t Delay(std::int64_t at_us);

 private:
  void Draw(std::int64_t after_us);
  double per_s_;
  std::int64_t min_us_, max_us_;
  Random random_;
  bool started_ = false;
  std::int64_t begin_us_ = 0, end_us_ = 0;
};

class ImpairPath {
 public:
  /// `profile` must outlive the path. Every effect has its own random stream forked from `random`,
  /// so that switching one on does not change the decisions of another.
  ImpairPath(const ImpairProfile& profile, const Random& random);

  /// Decides the fate of the next datagram. Requires times that do not decrease.
  Fate Next(std::int64_t now_us, std::size_t bytes);

 private:
  /// Returns the time at which the datagram leaves the bottleneck; -1 if its queue is full.
  std::int64_t Depart(std::int64_t now_us, std::size_t bytes);
  bool Lost(std::int64_t now_us);
  bool InOutage(std::int64_t now_us);
  void Arrive(Fate& fate, std::int64_t due_us, std::int64_t now_us, std::size_t bytes);

  const ImpairProfile& profile_;
  Random jitter_, reorder_, duplicate_, corrupt_, loss_, outage_;
  const Random outage_length_;  // forked by period, never advanced
  Stalls spikes_, stalls_;
  bool bad_ = false;                 // state of the Gilbert-Elliott chain
  std::int64_t link_free_us_ = 0;    // the bottleneck has sent everything accepted by then
  std::int64_t last_due_us_ = 0;     // lower bound of the next due time: keeps the order
  std::int64_t outage_number_ = -1;  // period that outage_us_ belongs to
  std::int64_t outage_us_ = 0;
};

}  // namespace seam
