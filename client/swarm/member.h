#pragma once
/// A member of a swarm: a real Client on its own socket, without bus, view and smoother, and the
/// cost of running it.

#include <cstdint>

#include "client/client.h"
#include "common/base/duration_histogram.h"
#include "common/net/udp.h"

namespace seam {

/// Measurements of one member, or of several together.
struct MemberFigures {
  DurationHistogram late;       ///< of each tick: its start after it was due
  DurationHistogram tick_cost;  ///< CPU time of a call that stepped ticks, divided among them
  std::int64_t ticks = 0;
  std::int64_t cpu_us = 0;  ///< sum of all calls
  void Add(const MemberFigures& other);
};

class Member {
 public:
  /// Throws OperatorError if there are no more sockets.
  explicit Member(const ClientConfig& config);

  /// Does the work due at `now_us` (SteadyClockUs). `cpu_us`: the thread's CPU time as last read;
  /// it is read again, which costs as much as a datagram.
  void Tick(std::int64_t now_us, std::int64_t* cpu_us);
  /// Returns the latest time for the next call of Tick.
  std::int64_t due_us() const { return due_us_; }
  /// For epoll: readable when Tick has something to do.
  int fd() const { return udp_.fd(); }
  /// Says goodbye; call Tick no more.
  void Leave(std::int64_t now_us) { client_.Shutdown(now_us); }

  const std::string& name() const { return name_; }
  const Client& client() const { return client_; }
  const MemberFigures& figures() const { return figures_; }
  /// Restarts the measurements, so that joining is not counted as load.
  void Forget() { figures_ = MemberFigures(); }

 private:
  /// A recorder that discards everything.
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
