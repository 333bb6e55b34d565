#pragma once
/// What leaves the bounds of its scene leaves the room: with its whole mechanism, by edits. Decided
/// by the server alone: of what a client has by what the client says, of all else from its own
/// world.

#include <cstdint>
#include <map>
#include <vector>

#include "common/sync/replica.h"
#include "common/topology/edit.h"

namespace seam {

/// Whether a point is beyond one of the scene's bounds. NaN is not.
bool OutsideBounds(const Scene& scene, const Vec2& position);

class BoundsWatch {
 public:
  /// `replica`, the server's, must outlive it.
  explicit BoundsWatch(const Replica& replica) : replica_(replica) {}

  /// To be called once after each tick. `told`: bodies of which their authorities say that they are
  /// outside. The removals of parts that are due now, at most kPartsMax; those asked for in the
  /// last kAgainSeconds, which may still wait for their order, are not among them.
  /// What is absent in a large room is looked at twice a second.
  std::vector<Edit> Next(const std::vector<int>& told);
  /// To be called with each edit that was applied.
  void NoteApplied(const Edit& edit);
  /// Parts that have left since the start.
  std::int64_t left() const { return left_; }

  /// Removals of one tick: what else is outside waits for the next.
  static constexpr std::size_t kPartsMax = 64;
  /// A removal that was not ordered in this time was forgotten (EditLog), s.
  static constexpr int kAgainSeconds = 4;

 private:
  /// Whether the server's own copy decides about a body.
  bool IsOurs(int body) const;

  const Replica& replica_;
  std::map<PartId, std::int64_t> asked_;  // tick
  std::int64_t left_ = 0;
};

}  // namespace seam
