#pragma once
/// What a peer tells the server of impacts: those that can hurt a part of a body that it has
/// authority over. The server decides whether to believe them, and what they cost.

#include <cstdint>
#include <deque>
#include <vector>

#include "common/codec/messages.h"
#include "common/physics/world.h"
#include "common/sync/roles.h"

namespace seam {

class ImpactReporter {
 public:
  /// Both must outlive this.
  ImpactReporter(const World& world, const Roles& roles) : world_(world), roles_(roles) {}

  /// After a step: what the world felt in it. `again`: the tick was stepped before; an impact of
  /// the same two bodies within kSameImpactTicks of one that was told is that one.
  void Note(bool again = false);
  /// What was noted since the last call, a message for each tick and at most kReportedImpactsMax
  /// impacts of it; utime is left 0.
  std::vector<ImpactReport> Take();

  /// A replay has the same collision a tick or two apart.
  static constexpr std::int64_t kSameImpactTicks = 3;

 private:
  struct Told {
    std::int64_t tick = 0;
    PartId id = 0, by = 0;
  };

  /// Whether a change of the body's velocity by `dv` hurts any of its parts.
  bool Hurts(int body, float dv) const;
  bool WasTold(std::int64_t tick, PartId id, PartId by) const;
  void NoteOne(const Impact& impact, int body, int by, bool again);

  const World& world_;
  const Roles& roles_;
  std::vector<ImpactReport> reports_;
  std::deque<Told> told_;  // of the last second
};

}  // namespace seam
