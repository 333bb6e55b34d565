#pragma once
/// Reports impacts to the server: those that can hurt a part of a body under this peer's authority.
/// The server decides whether to believe a report, and its cost.

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

  /// Call after a step. Records its impacts. `again`: the tick was stepped before; an impact of the
  /// same two bodies within kSameImpactTicks of a reported one is the same impact.
  void Note(bool again = false);
  /// Returns the impacts since the last call: one message per tick, with at most
  /// kReportedImpactsMax impacts; utime is left 0.
  std::vector<ImpactReport> Take();

  /// A replay may repeat the same collision a tick or two apart.
  static constexpr std::int64_t kSameImpactTicks = 3;

 private:
  struct Told {
    std::int64_t tick = 0;
    PartId id = 0, by = 0;
  };

  /// True if a velocity change of `dv` hurts any part of the body.
  bool Hurts(int body, float dv) const;
  bool WasReported(std::int64_t tick, PartId id, PartId by) const;
  void NoteOne(const Impact& impact, int body, int by, bool again);

  const World& world_;
  const Roles& roles_;
  std::vector<ImpactReport> reports_;
  std::deque<Told> told_;  // of recent ticks
};

}  // namespace seam
