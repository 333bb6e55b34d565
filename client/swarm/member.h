#pragma once
/// One of a swarm: a real Client on a socket of its own, without bus, view and smoother, and what
/// it took to run it.

#include <cstdint>

#include "client/client.h"
#include "common/base/duration_histogram.h"
#include "common/net/udp.h"

namespace seam {

/// What was counted of one member, or of several together.
struct MemberFigures {
  DurationHistogram late;       ///< of each tick: how long after it was due it began
  DurationHistogram tick_cost;  ///< CPU time of the calls in which ticks were stepped, for each
  std::int64_t ticks = 0;
  std::int64_t cpu_us = 0;  ///< of all calls
  void Add(const MemberFigures& other);
};

class Member {
 public:
  /// Throws OperatorError when there is no socket to be had.
  explicit Member(const ClientConfig& config);

  /// Runs what is due at `now_us` (SteadyClockUs). `cpu_us`: of this thread when it was last read,
  /// which is then read again: that costs as much as a datagram.
  void Tick(std::int64_t now_us, std::int64_t* cpu_us);
  /// When to call Tick again at the latest.
  std::int64_t due_us() const { return due_us_; }
  /// For epoll: readable when Tick has something to do.
  int fd() const { return udp_.fd(); }
  /// Says goodbye; call Tick no more.
  void Leave(std::int64_t now_us) { client_.Shutdown(now_us); }

  const std::string& name() const { return name_; }
  const Client& client() const { return client_; }
  const MemberFigures& figures() const { return figures_; }
  /// Begins to count anew: what joining took is no part of the load.
  void Forget() { figures_ = MemberFigures(); }

 private:
  /// Nobody listens.
  class Nowhere : public Recorder {
   public:
    bool listening() const override { return false; }

   public:
    void Publish(const std::string&, std::int64_t, ByteView) override {}
  };

  std::string name_;
  UdpNet udp_;
  Nowhere nowhere_;
  OsEntropy entropy_;
  Client client_;
  std::int64_t due_us_ = 0;
  std::int64_t spent_us_ = 1;  // CPU time of all calls so far; 0 would be "not known"
  MemberFigures figures_;
};

}  // namespace seam
