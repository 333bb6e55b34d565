#pragma once
/// Chooses the own bodies for a peer's next States. A client sends those of the highest priority,
/// at most kBodiesPerSend; the others wait and gain priority. Where every peer comes to the same
/// state by itself (Roles::RefreshesOnly), a body is due kRefreshHz times a second. Bodies falling
/// asleep are sent a few times, and no more once they are committed to rest (RestCommit).

#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/body_memory.h"
#include "common/sync/mode.h"
#include "common/sync/quantize.h"
#include "common/sync/reach/reach.h"
#include "common/sync/roles.h"
#include "common/sync/rollback/replay.h"

namespace seam {

/// Most bodies in one send of a client: four datagrams. More take turns by priority.
constexpr std::size_t kBodiesPerSend = 4 * kStatesBodiesMax;

class SendScheduler {
 public:
  /// All must outlive this. If the peer rolls back for late inputs, `reach` must be up to date at
  /// Collect.
  SendScheduler(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory,
                const Reach& reach, const Replay& replay);

  /// Call after a step. Collects states if a send is due. Drops states not taken since the last
  /// call.
  void Collect();
  /// Returns the collected states; utime is left 0.
  std::vector<States> Take();
  /// Returns the current state of every body that is not committed to rest, under any authority,
  /// for a peer that joins; utime is left 0.
  std::vector<States> Everything() const;

 private:
  bool Due(int body);
  bool SendsStateOf(int body) const;
  std::vector<int> ChooseBodies();
  WireBody Describe(int body, const BodyState& state, bool asleep) const;
  WireBody Tell(int body, std::int64_t tick);
  void NoteTold(int body, std::int64_t tick);
  /// Tick for which a body's state is sent.
  std::int64_t TickToSend(int body) const;
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
