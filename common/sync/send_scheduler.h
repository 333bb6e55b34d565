#pragma once
/// Which of its own bodies a peer sends in its next States: a client those of the highest priority,
/// at most kBodiesPerSend; the rest wait and gain priority. Bodies that fall asleep are sent a few
/// times, and no more once they are committed to rest (RestCommit).

#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/correct/replay.h"
#include "common/sync/mode.h"
#include "common/sync/quantize.h"
#include "common/sync/reach/reach.h"
#include "common/sync/roles.h"

namespace seam {

/// Bodies that a client tells of in one send: four datagrams. More than that take turns by
/// priority.
constexpr std::size_t kBodiesPerSend = 4 * kStatesBodiesMax;

class SendScheduler {
 public:
  /// All must outlive this. Where the peer goes back for late inputs, `reach` has looked before
  /// Collect.
  SendScheduler(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory,
                const Reach& reach, const Replay& replay);

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
  bool Speaks(int body) const;
  std::vector<int> ChooseBodies();
  PackedBody Describe(int body) const;
  PackedBody Tell(int body, std::int64_t tick);
  void NoteTold(int body, std::int64_t tick);
  /// The tick of which a body's state is told.
  std::int64_t ToldTick(int body) const;
  std::int64_t FinalTick(int mechanism) const;
  States Header() const;

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  BodyMemory& memory_;
  const Reach& reach_;
  const Replay& replay_;
  std::vector<States> outgoing_;
};

}  // namespace seam
