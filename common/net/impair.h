#pragma once
/// Makes any Net worse, repeatably: delay, jitter, bursts of loss, reorder, duplicates, bit flips,
/// stalls, outages, cuts and a rate limit, by named profiles.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/random.h"
#include "common/net/net.h"

namespace seam {

/// One direction of a path. All times in microseconds, probabilities in [0, 1].
struct ImpairProfile {
  std::string name;
  std::string about;          ///< one line for --help
  std::int64_t delay_us = 0;  ///< propagation
  /// Extra delay, exponential: its mean and its standard deviation are both this. Order is kept (a
  /// clump: a late datagram holds back those behind it).
  std::int64_t jitter_mean_us = 0;
  double loss_good_to_bad = 0;  ///< Gilbert-Elliott p, per datagram
  double loss_bad_to_good = 1;  ///< r
  double loss_in_bad = 1;       ///< 1 - h of the four-parameter model
  double loss_in_good = 0;      ///< 1 - k
  double reorder = 0;           ///< share of datagrams held back by reorder_us
  std::int64_t reorder_us = 0;
  double duplicate = 0;     ///< share that arrives twice, the copy a jitter later
  double corrupt = 0;       ///< share of datagrams with one flipped bit
  double spikes_per_s = 0;  ///< stalls after which everything comes in a burst
  std::int64_t spike_min_us = 0, spike_max_us = 0;
  std::int64_t rate_bits_per_s = 0;  ///< 0: no limit. 28 bytes of IP and UDP header count too
  double stalls_per_s = 0;           ///< a second, rarer kind of spike
  std::int64_t stall_min_us = 0, stall_max_us = 0;
  std::int64_t outage_period_us = 0;  ///< 0: none; else once in each period, at its end, ...
  std::int64_t outage_min_us = 0, outage_max_us = 0;  ///< ... for so long ...
  double outage_loss = 0;                             ///< ... this share is lost besides
};

/// Share of the datagrams that chance takes in the long run, by the Gilbert-Elliott model; without
/// outages and what a rate limit takes.
double MeanLoss(const ImpairProfile& profile);
/// Standard deviation of how many of `count` datagrams are lost, by the same model.
double LossDeviation(const ImpairProfile& profile, std::int64_t count);

/// What was offered to an impaired network, and what of it never arrives; in datagrams.
struct ImpairedTraffic {
  std::int64_t offered = 0, lost = 0;
};

/// The named profiles (`seam-server --help` lists them); `demo` is 50 ms each way, 10 ms jitter,
/// 1 % loss. Also reads a list in place of a name, of any of
///   delay=50ms  jitter=10ms  loss=1%  reorder=2%:30ms  duplicate=1%  corrupt=0.1%  rate=5Mb
///   spikes=0.1:100ms:600ms (per second, shortest, longest)  burst=1.02%:50% (p:r, all lost in bad)
/// joined by commas; times in us, ms or s, shares with % or from 0 to 1, rates in b, kb or Mb per
/// second. Throws OperatorError naming the known profiles when there is no such one.
ImpairProfile FindProfile(const std::string& name_or_spec);
const std::vector<ImpairProfile>& Profiles();
/// Their names.
std::vector<std::string> ProfileNames();

/// Impairs what passes through `inner`: outgoing by `out`, incoming by `in`, each peer address and
/// direction with its own random stream derived from `seed`. Order of the effects: rate limit,
/// propagation, jitter, stalls, reorder, duplicate, corrupt, loss.
///
/// What happens to a datagram depends on the seed, the peer's address, the direction and the sizes
/// and times (of the last Advance) of the datagrams before it on that path: on nothing else. Two
/// clients of one process with the same server need two seeds, or get the same impairments.
///
/// Memory is bounded: a path holds at most kPathBytesMax, all paths together kQueueBytesMax, and
/// at a rate limit a backlog of more than kBacklogUsMax is not accepted; the rest is lost.
class ImpairedNet : public Net {
 public:
  static constexpr std::size_t kPathBytesMax = 4u << 20;
  static constexpr std::size_t kQueueBytesMax = 64u << 20;
  static constexpr std::int64_t kBacklogUsMax = 500'000;  ///< a home router's buffer

  ImpairedNet(Net& inner, const ImpairProfile& out, const ImpairProfile& in, std::uint64_t seed);
  ~ImpairedNet() override;

  void Advance(std::int64_t now_us) override;
  void Send(const Address& to, ByteView datagram) override;
  void Flush() override;
  /// In the order in which datagrams are due; those due together in the order they came in.
  bool Receive(Address* from, Bytes* datagram) override;
  std::int64_t discarded() const override;

  /// Nothing passes either way while cut (what is under way is lost).
  void Cut(bool cut);
  /// Of both directions since the start, without what a cut took.
  ImpairedTraffic traffic() const;
  /// When the next delayed datagram is due, INT64_MAX if none: how long a main may sleep.
  std::int64_t next_due_us() const;
  /// Something that was sent is still under way.
  bool sending() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
