#pragma once
/// Which of its own bodies a peer sends in its next States: those of the highest priority, as many
/// as fit one datagram; the rest wait and gain priority. Bodies that fall asleep are sent a few
/// times, and no more once they are committed to rest (RestCommit).

#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/quantize.h"
#include "common/sync/roles.h"

namespace seam {

class SendScheduler {
 public:
  /// All four must outlive this.
  SendScheduler(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory);

  /// After a step. If a send is due, collects what is to be told. What was not taken since the last
  /// call is dropped.
  void Collect();
  /// What Collect found, if anything; utime is left 0.
  std::vector<States> Take();
  /// The current state of all bodies, whoever has them, for one who joins, but of those that are
  /// committed to rest; utime is left 0.
  std::vector<States> Everything() const;

 private:
  bool Due(int body);
  std::vector<int> ChooseBodies();
  PackedBody Describe(int body) const;
  PackedBody Tell(int body);
  States Header() const;

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  BodyMemory& memory_;
  std::vector<States> outgoing_;
};

}  // namespace seam
