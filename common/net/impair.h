#pragma once
/// Makes any Net worse, repeatably: delay, jitter, bursts of loss, reorder, duplicates, bit flips,
/// cuts and a rate limit, by named profiles.

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
  std::string about;                   ///< one line for --help
  std::int64_t delay_us = 0;           ///< propagation
  std::int64_t jitter_mean_us = 0;     ///< exponential extra delay; order is kept (a clump)
  double loss_good_to_bad = 0;         ///< Gilbert-Elliott p
  double loss_bad_to_good = 1;         ///< r
  double loss_in_bad = 1;              ///< 1 - h of the four-parameter model
  double loss_in_good = 0;             ///< 1 - k
  double reorder = 0;                  ///< share of datagrams held back by reorder_us
  std::int64_t reorder_us = 0;
  double duplicate = 0;
  double corrupt = 0;                  ///< share of datagrams with one flipped bit
  double spikes_per_s = 0;             ///< stalls after which everything comes in a burst
  std::int64_t spike_min_us = 0, spike_max_us = 0;
  std::int64_t rate_bits_per_s = 0;    ///< 0: no limit
};

/// The named profiles (docs/network-profiles in --help); `demo` is 50 ms each way, 10 ms jitter,
/// 1 % loss. Also reads "delay=50ms,jitter=10ms,loss=1%,reorder=..." in place of a name.
/// Throws OperatorError naming the known profiles when there is no such one.
ImpairProfile FindProfile(const std::string& name_or_spec);
const std::vector<ImpairProfile>& Profiles();

/// Impairs what passes through `inner`: outgoing by `out`, incoming by `in`, each peer address and
/// direction with its own random stream derived from `seed`. Order of the effects: rate limit,
/// propagation, jitter, reorder, duplicate, corrupt, loss.
class ImpairedNet : public Net {
 public:
  ImpairedNet(Net& inner, const ImpairProfile& out, const ImpairProfile& in, std::uint64_t seed);
  ~ImpairedNet() override;

  void Advance(std::int64_t now_us) override;
  void Send(const Address& to, ByteView datagram) override;
  void Flush() override;
  bool Receive(Address* from, Bytes* datagram) override;

  /// Nothing passes either way while cut (what is under way is lost).
  void Cut(bool cut);
  /// When the next delayed datagram is due, INT64_MAX if none: how long a main may sleep.
  std::int64_t next_due_us() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
