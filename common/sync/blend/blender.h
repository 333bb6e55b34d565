#pragma once
/// Corrects copies by the room's reconciler: once for each state that arrives, and before every
/// step if the reconciler is a puller. With rollback, and in mode central, only for states of ticks
/// that a replay cannot reach.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/blend/reconcile.h"
#include "common/sync/body_memory.h"
#include "common/sync/display.h"
#include "common/sync/mode.h"
#include "common/sync/roles.h"

namespace seam {

class Blender {
 public:
  /// Index of an entry in a States message, and its body.
  using Entry = std::pair<std::size_t, int>;

  /// All must outlive this.
  Blender(const SyncConfig& config, World& world, const Roles& roles, BodyMemory& memory,
          Display& display)
      : config_(config), world_(world), roles_(roles), memory_(memory), display_(display) {}

  /// Corrects the copies of these entries of a message. Requires copies that are simulated here.
  void Correct(const States& states, const std::vector<Entry>& entries);
  /// Call before a step. Pulls copies towards the authority's states, if the rule is a puller.
  void Pull();

 private:
  /// Mass-weighted mean of Xr(t1) - Xl(t1) by mechanism.
  std::map<int, BodyState> CommonDifferences(const States& states,
                                             const std::vector<Entry>& entries) const;
  /// Returns our comparable past at `tick`, with the velocity of the nearby tick at which our copy
  /// moved most like `remote`. Requires such a past.
  BodyState LikePast(int body, std::int64_t tick, const BodyState& remote) const;
  void CorrectOne(int body, const States& states, std::size_t i, const BodyState& common);
  void TakeRest(int body, const BodyState& local, const BodyState& remote);
  void Apply(int body, const BodyState& local, const Correction& c, std::int64_t from);
  BodyState PullTarget(int body, std::int64_t at) const;
  void RecordArrival(int body);

  const SyncConfig& config_;
  World& world_;
  const Roles& roles_;
  BodyMemory& memory_;
  Display& display_;
};

}  // namespace seam
