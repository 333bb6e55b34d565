#pragma once
/// Impairs any Net repeatably by named profiles: delay, jitter, bursts of loss, reordering,
/// duplicates, bit flips, stalls, outages, cuts and a rate limit.

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
  /// Mean and standard deviation of the extra delay, which is exponential. Order is kept: a late
  /// datagram holds back all behind it, so that a clump arrives.
  std::int64_t jitter_mean_us = 0;
  double loss_good_to_bad = 0;  ///< Gilbert-Elliott p, per datagram
  double loss_bad_to_good = 1;  ///< r
  double loss_in_bad = 1;       ///< 1 - h of the four-parameter model
  double loss_in_good = 0;      ///< 1 - k
  double reorder = 0;           ///< share of datagrams delayed by reorder_us
  std::int64_t reorder_us = 0;
  double duplicate = 0;     ///< share that arrives twice, the copy one jitter later
  double corrupt = 0;       ///< share of datagrams with one flipped bit
  double spikes_per_s = 0;  ///< stalls after which everything comes in a burst
  std::int64_t spike_min_us = 0, spike_max_us = 0;
  std::int64_t rate_bits_per_s = 0;  ///< 0: no limit; includes 28 bytes of IP and UDP header
  double stalls_per_s = 0;           ///< a second, rarer kind of spike
  std::int64_t stall_min_us = 0, stall_max_us = 0;
  std::int64_t outage_period_us = 0;  ///< one outage at the end of each period; 0: none
  std::int64_t outage_min_us = 0, outage_max_us = 0;  ///< range of its length
  double outage_loss = 0;                             ///< extra share lost in an outage
};

/// Returns the long-run share of datagrams lost by the Gilbert-Elliott model; outages and losses at
/// a rate limit are not included.
double MeanLoss(const ImpairProfile& profile);
/// Returns the standard deviation of the number lost of `count` datagrams, by the same model.
double LossDeviation(const ImpairProfile& profile, std::int64_t count);

/// Datagrams offered to an impaired network, and those of them that it did not take: lost to its
/// profile (loss, outages, rate limit), or for lack of memory.
struct ImpairedTraffic {
  std::int64_t offered = 0, lost = 0;
};

/// Returns a profile by name (`seam-server --help` lists them); `demo` is 50 ms each way, 10 ms
/// jitter, 1 % loss. In place of a name, takes a comma-separated list of any of
///   delay=50ms  jitter=10ms  loss=1%  reorder=2%:30ms  duplicate=1%  corrupt=0.1%  rate=5Mb
///   spikes=0.1:100ms:600ms (per second, shortest, longest)  burst=1.02%:50% (p:r, all lost in bad)
/// with times in us, ms or s, shares with % or from 0 to 1, rates in b, kb or Mb per second. Throws
/// OperatorError that lists the known profiles if the name is unknown.
ImpairProfile FindProfile(const std::string& name_or_spec);
const std::vector<ImpairProfile>& Profiles();
/// Returns the names of Profiles().
std::vector<std::string> ProfileNames();

/// Impairs the traffic of `inner`: outgoing by `out`, incoming by `in`. Each peer address and
/// direction has its own random stream derived from `seed`. Order of the effects: rate limit,
/// propagation, jitter, stalls, reorder, duplicate, corrupt, loss.
///
/// The fate of a datagram depends only on the seed, the peer's address, the direction, and the
/// sizes and times (of the last Advance) of the datagrams before it on that path. Two clients of
/// one process with the same server need two seeds, or get the same impairments.
///
/// Memory is bounded: datagrams are lost beyond kPathBytesMax per path, kQueueBytesMax in all, and
/// beyond a backlog of kBacklogUsMax at a rate limit.
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
  /// Returns datagrams in the order of their due times; ties keep the order of arrival.
  bool Receive(Address* from, Bytes* datagram) override;
  std::int64_t discarded() const override;

  /// Impairs what comes from now on by other profiles; datagrams in flight keep their times, so
  /// that a shorter delay lets new ones overtake them, as on another route.
  void Change(const ImpairProfile& out, const ImpairProfile& in);
  /// Cuts or restores the network. A cut loses everything in both directions, also datagrams in
  /// flight.
  void Cut(bool cut);
  /// Returns the counts of both directions since the start; losses by a cut are not included.
  ImpairedTraffic traffic() const;
  /// Returns the due time of the next delayed datagram, INT64_MAX if none: a main may sleep until
  /// then.
  std::int64_t next_due_us() const;
  /// Returns true while sent datagrams are still delayed here.
  bool sending() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
